"""What a user sees of an answer: its state, its first words, the number that decides, and its figures."""

from tests.app.driving import drawn
from tests.app.outputs import overflow
from tests.helpers.processes import wait_until

# Texts in the place of an answer, a part of it or a figure that is to come or belongs to earlier inputs.
PLACEHOLDERS = (
    "not tried yet",
    "Nothing is solved yet",
    "Points are being solved",
    "Run fills the map.",
    "The verdict follows with the last of them.",
    "The inputs have changed",
    "Computing …",
    "Checking …",
    "Computing the breakdown over the speed …",
    "being computed",
    "This figure is not computed.",
    "its range within the stated ranges follows",
    "new values follow",
    "No answer",
    "Not converged",
    "NOT CONVERGED",
    "No verdict before solving",
    "No verdict without a simulation",
    "From film-thickness formulas. Solving computes",
    "Film, pressure and field stand here when the film is solved.",
    "By the capacitive divider, without a simulation.",
    "Films of the atlas, and voltages right after an edge.",
    "The effects stand here when both cases have an answer.",
    "belong to earlier inputs",
    "belongs to earlier inputs",
    "is of earlier inputs",
    "are of earlier inputs",
    "The values below belong to the present inputs.",
    "is not computed; its field says why.",
    "the critical speeds took too long and are omitted",
    "No movie yet.",
)

# A map also says how many of its points are open, a number is "…", and parts are dimmed or have no colour.
_UNFINISHED = r"""
placeholders => {
  const seen = part => part.getClientRects().length > 0;
  const all = selector => [...document.querySelectorAll(selector)].filter(seen);
  const figures = all('.js-plotly-plot').flatMap(figure => [
    ...(figure.data || []).map(trace => trace.name || ''),
    ...(figure.layout?.annotations || []).map(note => note.text || ''),
  ]);
  const texts = [document.body.innerText, ...figures].join('\n');
  const open = all('[data-testid=map-note]').filter(note => /\d open/.test(note.innerText));
  const pending = all('.answer *').filter(part => !part.children.length && part.textContent.trim() === '…');
  const marks = ['follows', 'stale', 'stopped', 'old', 'waits', 'verdict.grey'];
  return [
    ...placeholders.filter(text => texts.includes(text)),
    ...[...open, ...pending, ...all('[role=alert]')].map(part => part.innerText.trim()).filter(Boolean),
    ...['[aria-busy=true]', ...marks.map(mark => `.${mark}`)].flatMap(
      mark => all(mark).map(part => `${mark}: ${part.innerText.slice(0, 80)}`)),
  ];
}
"""

# The largest number of finite points of a trace, or of cells of a map with a scale: grey cells are no values.
# Plotly also keeps arrays as base64 of their bytes.
_FIGURES = r"""
() => {
  const types = {f8: Float64Array, f4: Float32Array, i4: Int32Array, u4: Uint32Array, i2: Int16Array,
    u2: Uint16Array, i1: Int8Array, u1: Uint8Array};
  const flat = values => {
    if (values?.bdata) {
      const bytes = Uint8Array.from(atob(values.bdata), letter => letter.charCodeAt(0));
      return [...new types[values.dtype](bytes.buffer)];
    }
    const several = Array.isArray(values) || ArrayBuffer.isView(values);
    return several ? [...values].flatMap(flat) : [values];
  };
  const there = value => typeof value === 'string' ? value !== '' : Number.isFinite(value);
  const count = trace => {
    const unseen = [false, 'legendonly'].includes(trace.visible) || trace.marker?.opacity === 0;
    if (unseen || trace.showscale === false) return 0;
    const axes = (trace.z ? [trace.z] : [trace.x, trace.y, trace.r, trace.theta]).filter(Boolean).map(flat);
    return axes.length ? axes[0].filter((_, place) => axes.every(axis => there(axis[place]))).length : 0;
  };
  const seen = [...document.querySelectorAll('.js-plotly-plot')].filter(part => part.getClientRects().length);
  return seen.map(part => {
    const edges = [part, ...part.querySelectorAll('.main-svg')].map(box => box.getBoundingClientRect());
    return {
      name: part.closest('[data-testid]').dataset.testid,
      points: Math.max(0, ...(part.data || []).map(count)),
      cells: Math.max(0, ...(part.data || []).filter(trace => trace.type === 'heatmap').map(count)),
      left: Math.min(...edges.map(box => box.left)),
      right: Math.max(...edges.map(box => box.right)),
    };
  });
}
"""


def settle(page):
    """Wait until a page has its final answer; what is left of an earlier state fails the test by its name."""
    left = []

    def finished():
        left[:] = page.evaluate(_UNFINISHED, PLACEHOLDERS)
        return not left

    assert wait_until(finished), left


def heading(part):
    """First words of the verdict of a page or a part of it, and its level."""
    verdict = part.get_by_test_id("verdict")
    return verdict.locator("h2 > :nth-child(2)").inner_text(), verdict.get_attribute("data-level")


def deciding(part):
    """Key of the number that decides the verdict, and its text without the sign of a bound."""
    box = part.locator(".deciding [data-testid^=number-]")
    value = box.get_by_test_id("value").inner_text()
    return box.get_attribute("data-testid").removeprefix("number-"), value.lstrip("≤ ")


def figures(page):
    """Figures that are seen by their names, once they are drawn."""
    drawn(page)
    return {figure["name"]: figure for figure in page.evaluate(_FIGURES)}


def see_figures(page, *names, widths=(1280, 400)):
    """See figures in windows of these widths [px]; returns all that are seen.

    The figures of the names are among them, each has data, and nothing is wider than the window.
    """
    size = page.viewport_size
    for width in widths:
        page.set_viewport_size(size | {"width": width})
        page.wait_for_function("width => document.documentElement.clientWidth === width", arg=width)
        settle(page)
        seen = {}

        def fits(seen=seen, width=width):
            seen.clear()
            seen.update(figures(page))
            inside = all(figure["left"] >= 0 and figure["right"] <= width for figure in seen.values())
            return {*names} <= seen.keys() and inside and overflow(page) <= 0

        assert wait_until(fits), (width, overflow(page), seen)
        assert all(figure["points"] > 1 for figure in seen.values()), seen
    page.set_viewport_size(size)
    return seen
