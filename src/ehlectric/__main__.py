"""``python -m ehlectric`` is the ``ehlectric`` command."""

from __future__ import annotations

import gc
import sys

from ehlectric.runtime.memory import in_bytes, is_out_of_memory, left_of_process, out_of_memory
from ehlectric.runtime.worker_processes import cores, limit_blas

# Memory that the libraries of every command take [bytes of address space], and memory of BLAS for each core.
# With less they fail without a message: BLAS waits endlessly, or ends the process.
LEAST_MEMORY, MEMORY_OF_CORE = 750_000_000, 20_000_000
_TOO_LITTLE, _INTERRUPTED = 2, 130

# New objects after which Python searches them for cycles, for the first time and later. Loading the
# libraries makes up to 150,000 that stay: with the usual 700 the searches take a tenth of a short command.
_LOADED_OBJECTS, _NEW_OBJECTS = 200_000, 10_000


def main() -> None:
    """Entry point of the ``ehlectric`` command, also where there is almost no memory."""
    left, least = left_of_process(), LEAST_MEMORY + MEMORY_OF_CORE * cores()
    if left < least:
        message = f"memory: got {in_bytes(max(0.0, left))}, what ulimit leaves to this process"
        sys.exit(_end(f"{message}; expected at least {in_bytes(least)}"))
    gc.set_threshold(_LOADED_OBJECTS)
    gc.callbacks.append(_search_more_often)
    # Films and fields are factorised on one thread. Idle threads of BLAS would take processor time.
    limit_blas()
    try:
        from ehlectric.commands.command_line import exit_status, process
    except KeyboardInterrupt:
        # As the commands end, which have not been loaded yet.
        sys.exit(_INTERRUPTED)
    except Exception as error:
        if not is_out_of_memory(error):
            raise
        sys.exit(_end(out_of_memory(error)))
    with process():
        status = exit_status()
    # At its exit Python would search all objects for cycles, although the system takes their memory anyway.
    gc.freeze()
    sys.exit(status)


def _search_more_often(_: str, __: dict[str, int]) -> None:
    """Limit what cycles keep of the memory after the first search, as the libraries have been loaded."""
    gc.callbacks.remove(_search_more_often)
    gc.set_threshold(_NEW_OBJECTS)


def _end(text: str) -> int:
    """Print why there is no command, and return its exit status."""
    print(f"error: {text}", file=sys.stderr)  # noqa: T201
    return _TOO_LITTLE


if __name__ == "__main__":
    main()
