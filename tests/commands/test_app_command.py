"""``ehlectric app`` as a user starts and ends it, and what its server answers to whom."""

import http.client
import os
import signal
import socket
import subprocess
import sys
from contextlib import closing, suppress

import nicegui
import pytest
import simple_websocket

from tests.helpers.app_server import AppServer
from tests.helpers.each import each
from tests.helpers.processes import PATIENCE, alive, wait_until

# Status of a process that a signal ended, as shells tell it.
_TERMINATED, _HUNG_UP = 128 + signal.SIGTERM, 128 + signal.SIGHUP


@pytest.fixture(scope="module")
def server(tmp_path_factory):
    server = AppServer(tmp_path_factory.mktemp("app"))
    yield server
    server.stop()


def ask(server, path, method="GET", body=None, **headers):
    """Status, headers and text of a response; the path is sent as it is."""
    with closing(http.client.HTTPConnection("127.0.0.1", server.port, timeout=PATIENCE)) as connection:
        connection.putrequest(method, path, skip_host="host" in headers)
        for name, value in headers.items():
            connection.putheader(name.replace("_", "-"), value)
        connection.endheaders(body)
        response = connection.getresponse()
        return response.status, response.headers, response.read().decode("utf-8", "replace")


@pytest.mark.slow
@pytest.mark.parametrize(
    ("number", "status"),
    [
        (signal.SIGINT, 0),
        pytest.param(signal.SIGTERM, _TERMINATED, marks=pytest.mark.gate),
        (signal.SIGHUP, _HUNG_UP),
        (signal.SIGKILL, -signal.SIGKILL),
    ],
)
def test_a_server_ends_with_all_its_processes(tmp_path, number, status):
    server = AppServer(tmp_path)
    # The address is told when the server answers, and not before.
    assert ask(server, "/")[0] == 200
    # The fork server, its tracker, and a process of quick answers at least.
    assert wait_until(lambda: len(server.processes()) >= 4)
    processes = server.processes()
    assert server.stop(number) == status
    assert wait_until(lambda: not any(map(alive, processes)))
    assert server.log.read_text() == ""
    assert not list(server.folder.iterdir())
    if number == signal.SIGKILL:
        # Nothing runs after such a signal; the next server removes what is left.
        assert list(server.temporary.iterdir())
        server = AppServer(tmp_path)
        assert server.stop() == 0
    assert not list(server.temporary.iterdir())


@pytest.mark.slow
def test_a_long_path_of_temporary_files_is_no_obstacle(tmp_path):
    """The names of sockets are bounded to about 100 characters."""
    folder = tmp_path / ("long" * 20)
    folder.mkdir()
    server = AppServer(folder)
    assert wait_until(lambda: len(server.processes()) >= 4)
    assert server.stop() == 0
    assert server.log.read_text() == ""
    assert not list(server.temporary.iterdir())


@pytest.mark.slow
def test_a_server_that_is_stopped_while_it_loads_ends(tmp_path):
    server = AppServer(tmp_path)
    assert server.stop() == 0
    assert not list(server.temporary.iterdir())


@pytest.mark.slow
def test_a_taken_port_is_one_line(ehlectric):
    with socket.socket() as other:
        other.bind(("127.0.0.1", 0))
        other.listen()
        port = other.getsockname()[1]
        done = ehlectric("app", "--port", port, "--no-browser")
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr.startswith(f"error: --port: {port} ")
    assert done.stderr.count("\n") == 1


@pytest.mark.slow
def test_a_missing_nicegui_is_one_line(tmp_path):
    code = "import sys; sys.modules['nicegui'] = None; sys.argv[1:] = ['app']; "
    code += "from ehlectric.__main__ import main; main()"
    done = subprocess.run(
        [sys.executable, "-c", code],
        cwd=tmp_path,
        capture_output=True,
        text=True,
        env=os.environ,
        check=False,
    )
    assert done.returncode == 2
    assert done.stderr.startswith("error: app: ")
    assert 'pip install "ehlectric[app]"' in done.stderr


@pytest.mark.slow
@pytest.mark.gate
def test_the_process_of_the_server_loads_no_physics():
    heavy = "{'numpy', 'scipy', 'pint', 'pandas', 'matplotlib'}"
    code = f"import sys, ehlectric.app.server; print(sorted({heavy} & set(sys.modules)))"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout == "[]\n"


@pytest.mark.slow
def test_processes_load_what_a_bearing_by_formula_needs_and_no_more():
    heavy = "{'pint', 'pandas', 'xarray', 'matplotlib', 'h5netcdf', 'h5py', 'nicegui'}"
    code = f"import sys, ehlectric.app.compute.preload; print(sorted({heavy} & set(sys.modules)))"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout == "[]\n"


@pytest.mark.slow
@each("path", ["/docs", "/redoc", "/openapi.json", "/nothing", "/_nicegui", "/static/", "/.env"])
def test_there_is_nothing_beside_the_pages(server, path):
    status, _, text = ask(server, path)
    assert status == 404
    assert "Traceback" not in text
    assert str(server.folder) not in text


@pytest.mark.slow
@each("part", ["static", "libraries", "components", "resources/x", "esm/nicegui-plotly"])
@each("up", ["../", "%2e%2e/", "..%2f", "....//"])
def test_no_path_leads_out_of_the_files_of_nicegui(server, part, up):
    path = f"/_nicegui/{nicegui.__version__}/{part}/{up * 12}etc/passwd"
    status, _, text = ask(server, path)
    assert status in (403, 404)
    assert "root:" not in text


@pytest.mark.slow
@each("headers", [{"host": "attacker.example"}, {"origin": "http://attacker.example"}])
@each("path", ["/", "/_nicegui_ws/socket.io/?EIO=4&transport=polling"])
def test_other_names_and_other_sites_are_refused(server, path, headers):
    assert ask(server, path, **headers)[0] == 403


@pytest.mark.slow
def test_a_large_upload_is_refused_before_it_is_sent(server):
    status, _, text = ask(server, "/", "POST", content_length="2000000000")
    assert (status, text) == (413, "A request has at most 100 MB.")


@pytest.mark.slow
@each(
    "messages",
    [
        ["no digit"],
        [b"\x00\xff"],
        ["4no digit"],
        ["40{no table"],
        ["40", "42[no list"],
        ["40", '42["event", 3]'],
        ["40", '42["handshake", {"a": 1}]'],
        ["40", '451-["event",{"_placeholder":true,"num":0}]', b"bytes"],
        ["40", '499-["event"]'],
        ["4\N{SUPERSCRIPT TWO}"],
    ],
)
def test_a_message_that_is_none_of_the_protocol_is_one_line_of_the_log(server, messages):
    before = server.log.read_text()
    address = f"ws://127.0.0.1:{server.port}/_nicegui_ws/socket.io/?EIO=4&transport=websocket"
    browser = simple_websocket.Client.connect(address)
    for message in messages:
        browser.send(message)
    assert wait_until(lambda: server.log.read_text() != before)
    # The server itself has closed some of them.
    with suppress(simple_websocket.ConnectionClosed):
        browser.close()
    lines = server.log.read_text().removeprefix(before).splitlines()
    assert len(lines) == 1
    assert "Error" in lines[0]


@pytest.mark.slow
def test_a_page_binds_its_browser_to_the_server(server):
    status, headers, text = ask(server, "/")
    assert status == 200
    assert "script-src 'self' 'nonce-" in headers["content-security-policy"]
    assert headers["referrer-policy"] == "no-referrer"
    assert headers.get("set-cookie") is None
    assert "https://" not in text


@pytest.mark.slow
def test_a_server_for_others_asks_for_its_token(tmp_path):
    server = AppServer(tmp_path, "--host", "0.0.0.0")
    query = server.address.partition("localhost")[2].partition("/")[2]
    assert query.startswith("?token=")
    assert ask(server, "/")[0] == 403
    assert ask(server, "/?token=wrong")[0] == 403
    assert ask(server, f"/_nicegui_ws/socket.io/{query}&EIO=4&transport=polling", "POST")[0] == 403
    status, headers, text = ask(server, f"/{query}&bearing.base=%276208%27", host="machine.example:1")
    assert (status, query[7:] in text) == (200, False)
    assert (
        ask(server, "/", host="machine.example:1", cookie=headers["set-cookie"].partition(";")[0])[0] == 200
    )
    assert server.stop() == 0
