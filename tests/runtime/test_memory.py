"""Memory that is left by the machine, the shell and control groups, and errors that mean that none is."""

import errno
import resource
import subprocess
import sys
from pathlib import Path

import pytest

from ehlectric.errors import InputError, MemoryLimitError
from ehlectric.runtime import memory
from ehlectric.runtime.memory import (
    available_memory,
    in_bytes,
    is_out_of_memory,
    left_of_groups,
    left_of_process,
    out_of_memory,
    physical_memory,
)
from tests.helpers.each import each
from tests.helpers.processes import PATIENCE

V1 = "9:name=systemd:/\n4:cpu,memory:{path}\n0::/\n"
V2 = "0::{path}\n"


def machine(root, groups, mounts):
    """A process's files of the kernel, in a folder: its groups and its mounts."""
    (root / "self").mkdir()
    (root / "self" / "cgroup").write_text(groups)
    lines = [f"3{n} 31 0:3{n} {top} {at} rw - {kind}" for n, (top, at, kind) in enumerate(mounts)]
    (root / "self" / "mountinfo").write_text(
        "\n".join(["1 0 8:1 / / rw - ext4 /dev/sda rw", *lines, "odd", ""])
    )
    return {"process": root / "self", "root": root}


def group(folder, version, limit, used, spare=0):
    folder.mkdir(parents=True, exist_ok=True)
    names = ("memory.max", "memory.current", "inactive_file")
    if version == 1:
        names = ("memory.limit_in_bytes", "memory.usage_in_bytes", "total_inactive_file")
    (folder / names[0]).write_text(f"{limit}\n")
    (folder / names[1]).write_text(f"{used}\n")
    (folder / "memory.stat").write_text(f"anon 5\n{names[2]} {spare}\n")


def test_the_least_limit_of_a_group_and_those_above_it(tmp_path):
    """Version 2: the group has no limit, the one above has; contents of files do not count as used."""
    there = machine(tmp_path, V2.format(path="/user/job"), [("/", "/sys/fs/cgroup", "cgroup2 cgroup2 rw")])
    top = tmp_path / "sys/fs/cgroup"
    group(top / "user/job", 2, "max", 100)
    assert left_of_groups(**there) == float("inf")
    group(top / "user", 2, 5_000, 3_000, spare=1_000)
    assert left_of_groups(**there) == 3_000.0
    group(top / "user/job", 2, 4_000, 2_500)
    assert left_of_groups(**there) == 1_500.0
    group(top / "user", 2, 5_000, 6_000)
    assert left_of_groups(**there) == -1_000.0


@each("path", ["/docker/7", "/", "/../.."])
def test_a_container_sees_its_own_group(tmp_path_factory, path):
    """Version 1: the group of the container is mounted, whatever the path of the process's group."""
    mounts = [
        ("/docker/7", "/sys/fs/cgroup/memory", "cgroup cgroup rw,memory"),
        ("/", "/c", "cgroup c rw,cpu"),
    ]
    tmp_path = tmp_path_factory.mktemp("container")
    there = machine(tmp_path, V1.format(path=path), mounts)
    group(tmp_path / "sys/fs/cgroup/memory", 1, 2_000_000, 500_000, spare=100_000)
    group(tmp_path / "c", 1, 10, 0)  # another controller's
    assert left_of_groups(**there) == 1_600_000.0


def test_no_groups_no_limit(tmp_path):
    assert left_of_groups(tmp_path / "none", tmp_path) == float("inf")
    there = machine(tmp_path, V2.format(path="/"), [("/", "/sys/fs/cgroup", "cgroup2 cgroup2 rw")])
    assert left_of_groups(**there) == float("inf")
    group(tmp_path / "sys/fs/cgroup", 2, "no number", 0)
    assert left_of_groups(**there) == float("inf")


def test_the_limits_of_the_shell_minus_what_is_used(monkeypatch, tmp_path):
    limits = {resource.RLIMIT_AS: 8_000_000, resource.RLIMIT_DATA: resource.RLIM_INFINITY}
    monkeypatch.setattr(resource, "getrlimit", lambda kind: (limits[kind], resource.RLIM_INFINITY))
    status = tmp_path / "status"
    status.write_text("Name: x\nVmSize:\t 2000 kB\nVmData:\t 500 kB\n")
    assert left_of_process(status) == 8_000_000 - 2000 * 1024
    limits[resource.RLIMIT_DATA] = 1_000_000
    assert left_of_process(status) == 1_000_000 - 500 * 1024
    assert left_of_process(tmp_path / "none") == 1_000_000


def test_the_least_of_all_counts(monkeypatch):
    assert 0.0 < available_memory() <= physical_memory()
    monkeypatch.setattr(memory, "left_of_groups", lambda: 5.1e9)
    monkeypatch.setattr(memory, "physical_memory", lambda: 64e9)
    assert available_memory() == 5.1e9
    assert out_of_memory(MemoryError()) == (
        "out of memory; available are 5.1 GB, what its control group, as in a container, "
        "leaves to this process"
    )
    monkeypatch.setattr(memory, "left_of_process", lambda: -3.0)
    assert available_memory() == 0.0
    assert out_of_memory(MemoryError("for\nan array")) == (
        "out of memory: for an array; available are 0 B, what ulimit leaves to this process"
    )


def test_errors_that_mean_that_memory_ran_out():
    def chained():
        try:
            raise MemoryError
        except MemoryError:
            raise ValueError("damaged") from None

    with pytest.raises(ValueError, match="damaged") as error:
        chained()
    assert is_out_of_memory(error.value)
    assert is_out_of_memory(OSError(errno.ENOMEM, "Cannot allocate memory"))
    assert is_out_of_memory(ImportError("libx.so: failed to map segment from shared object"))
    assert is_out_of_memory(MemoryLimitError("grid.nodes", got="1", takes="2"))
    assert not is_out_of_memory(InputError("grid.nodes", got="1", takes="2"))
    assert not is_out_of_memory(OSError(errno.ENOSPC, "No space left on device"))
    assert not is_out_of_memory(None)


def test_sizes_in_words():
    assert [in_bytes(size) for size in (999, 1000, 1.5e6, 999_600_000)] == ["999 B", "1 kB", "1.5 MB", "1 GB"]


@pytest.mark.slow
@pytest.mark.parametrize("megabytes", [30, 100, 300, 500])
def test_limits_below_which_nothing_starts(megabytes):
    """BLAS would wait for ever, or end the process with lines of its own."""
    limit = megabytes * 1_000_000
    done = subprocess.run(
        [sys.executable, "-m", "ehlectric", "--version"],
        capture_output=True,
        text=True,
        timeout=PATIENCE,
        preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (limit, limit)),
    )
    assert done.returncode == 2
    assert done.stderr.startswith("error: memory: got ")
    assert "what ulimit leaves to this process; expected at least" in done.stderr
    assert done.stderr.count("\n") == 1
    assert done.stdout == ""


def test_a_system_without_limits(monkeypatch):
    monkeypatch.setitem(sys.modules, "resource", None)
    assert left_of_process(Path("/nowhere")) == float("inf")


def test_groups_are_read_ten_times_a_second_at_most(monkeypatch):
    clock, left, reads = [100.0], [3e9], []

    def groups():
        reads.append(clock[0])
        return left[0]

    monkeypatch.setattr(memory.time, "monotonic", lambda: clock[0])
    monkeypatch.setattr(memory, "left_of_groups", groups)
    monkeypatch.setattr(memory, "physical_memory", lambda: 64e9)
    assert available_memory() == 3e9
    left[0], clock[0] = 2e9, 100.05
    assert available_memory() == 3e9
    clock[0] = 100.2
    assert available_memory() == 2e9
    assert reads == [100.0, 100.2]
