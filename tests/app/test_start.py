"""Address that the server is bound to."""

import socket
import subprocess
import sys

import pytest

from ehlectric.app.start import listen
from ehlectric.errors import InputError
from tests.helpers.each import each


@pytest.fixture
def taken():
    """Port that another socket listens at."""
    with socket.socket() as other:
        other.bind(("127.0.0.1", 0))
        other.listen()
        yield other.getsockname()[1]


def test_a_port_is_listened_at_before_the_server_is_loaded():
    with listen("127.0.0.1", 0) as bound, socket.create_connection(bound.getsockname()):
        assert bound.getsockname()[1] > 0


def test_without_a_port_the_next_free_one_is_taken(taken, monkeypatch):
    with listen("127.0.0.1", None) as one, listen("127.0.0.1", None) as other:
        ports = {bound.getsockname()[1] for bound in (one, other)}
    assert len(ports) == 2
    assert ports < set(range(8080, 8180))
    # Other programs may hold ports of that range and give them back at any time.
    monkeypatch.setattr("ehlectric.app.start._PORTS", (taken, 0))
    with listen("127.0.0.1", None) as bound:
        assert bound.getsockname()[1] != taken


def test_a_taken_port_is_told(taken):
    with pytest.raises(InputError) as caught:
        listen("127.0.0.1", taken)
    assert str(caught.value).startswith(f"--port: {taken} ")


@each("host", ["203.0.113.7", "no such host", "1.2.3.4.5", ""])
def test_an_address_of_another_machine_is_told(host):
    with pytest.raises(InputError) as caught:
        listen(host, 0).close()
    assert (caught.value.key, caught.value.got) == ("--host", host)


def test_the_server_loads_no_client_and_no_physics():
    code = """
import sys
from ehlectric.app import start
with start._without(start._UNUSED):
    import ehlectric.app.server
print(*sys.modules)
"""
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    loaded = set(run.stdout.split())
    assert {"nicegui", "engineio"} < loaded
    assert not loaded & {"aiohttp", "requests", "tornado", "plotly", "numpy", "scipy"}
