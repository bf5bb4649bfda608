"""Use of a page as a user does it: by the fields and the numbers that are seen."""

import re

_NUMBER = re.compile(r"[-+]?\d+(?:\.\d+)?(?:e[-+]?\d+)?")


def type_into(page, key, text):
    """Type a text into the field of a dotted key, and leave the field."""
    box = field(page, key)
    box.fill(text)
    box.press("Tab")


def field(page, key):
    """Box of the field of a dotted key."""
    found = page.get_by_test_id(f"field-{key.replace('.', '-')}")
    return found if found.evaluate("box => box.matches('input')") else found.locator("input").last


def number(page, name):
    """Number that the page shows under a name, such as ``capacitance``; None where there is none yet."""
    try:
        texts = page.get_by_test_id(f"number-{name}").all_inner_texts()
    except Exception as error:
        # A page that is being replaced, as by the address without its token, shows none.
        if "context was destroyed" not in str(error):
            raise
        return None
    # The name of the quantity has no digits; the first number is its value.
    found = _NUMBER.search(" ".join(texts))
    return None if found is None else float(found[0])


def wait_for_number(page, name, expected, *, digits=3, seconds=20.0):
    """Wait until a number agrees with an expected one to a number of digits."""
    seen = None
    for _ in range(int(seconds / 0.1)):
        seen = number(page, name)
        if seen is not None and abs(seen / expected - 1.0) < 0.5 * 10.0 ** (1 - digits):
            return seen
        page.wait_for_timeout(100)
    raise AssertionError(f"{name}: {seen}, expected {expected}")
