"""Use of a page as a user does it: by the fields and the numbers that are seen."""

import re

from tests.helpers.processes import PATIENCE, wait_until

_NUMBER = re.compile(r"[-+]?\d+(?:\.\d+)?(?:e[-+]?\d+)?")


def connected(page):
    """Wait until a page is connected with its server; one that is refused has no connection."""
    page.wait_for_function("() => !window.socket || window.did_handshake")


def loaded_again(page):
    """Function that waits until a page was loaded anew since now, and is connected with its server again."""
    page.evaluate("() => { window.before = true; }")
    return lambda: page.wait_for_function("() => !window.before && window.did_handshake")


def seen(page, test_id):
    """The one element of a test mark that is seen, where a page has several of them."""
    return page.get_by_test_id(test_id).filter(visible=True)


def complete(page):
    """Wait until a page of a bearing has its whole answer, and help beside its fields; then it stays so."""
    page.locator("[data-testid=answer][data-whole=true][aria-busy=false]").wait_for()
    page.get_by_role("button", name="About Radial load").wait_for(state="attached")


def drawn(page):
    """Wait until all figures that are seen are drawn, and two frames more."""
    page.wait_for_function(
        "() => [...document.querySelectorAll('.js-plotly-plot')]"
        ".every(one => one.getAttribute('aria-busy') === 'false' || !one.getClientRects().length)"
    )
    page.evaluate("() => new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)))")


def wait_for_address(page, text):
    """Wait until the address of a page has a text: then the server has taken over the inputs."""
    page.wait_for_function(
        "text => decodeURIComponent(location.search.replaceAll('+', ' ')).includes(text)", arg=text
    )


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
    """Number that the page shows of a key, such as ``bearing.capacitance``; None where there is none yet."""
    try:
        texts = page.get_by_test_id(f"number-{name}").all_inner_texts()
    except Exception as error:
        # A page that is being replaced, as by the address without its token, shows none.
        if "context was destroyed" not in str(error):
            raise
        return None
    # The name of the quantity has no digits; the first number is its value.
    found = _NUMBER.search(" ".join(texts).replace("\xa0", ""))
    return None if found is None else float(found[0])


def wait_for_number(page, name, expected, *, digits=3, seconds=PATIENCE):
    """Wait until a number agrees with an expected one to a number of digits."""
    seen = None
    for _ in range(int(seconds / 0.1)):
        seen = number(page, name)
        if seen is not None and abs(seen / expected - 1.0) < 0.5 * 10.0 ** (1 - digits):
            return seen
        page.wait_for_timeout(100)
    raise AssertionError(f"{name}: {seen}, expected {expected}")


def wait_for_any_number(page, name):
    """Wait until the page shows any number under a name."""
    assert wait_until(lambda: number(page, name) is not None)
