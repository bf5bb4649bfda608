"""The ways a request can fail."""


class InputError(ValueError):
    """The input is wrong: one line that names the key, what it got and what it takes."""


class ConvergenceError(RuntimeError):
    """The equations were not solved; raised where the caller asks for a solution or nothing."""
