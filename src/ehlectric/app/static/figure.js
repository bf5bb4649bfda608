// Figure of Plotly. A page shows its texts before its figures, which are drawn one by one, those in sight first.
// After the first figure the server sends only what changed in it.
let Plotly;
const waiting = new Set();
let working = false;

// Resolves after the next picture of the page; a page in the background has none.
const painted = () => new Promise((done) => {
  requestAnimationFrame(() => setTimeout(done));
  setTimeout(done, 100);
});

const shown = (element) => element.getClientRects().length > 0;

// Distance from the part of the page that is in sight [px].
const distance = (element) => {
  const {top, bottom} = element.getBoundingClientRect();
  return Math.max(0, top - innerHeight, -bottom);
};

const work = async () => {
  if (working) return;
  working = true;
  while (waiting.size) {
    await painted();
    Plotly ??= (await import("nicegui-plotly")).Plotly;
    const [first] = [...waiting].sort((a, b) => distance(a.$el) - distance(b.$el));
    if (!first) break;
    waiting.delete(first);
    await first.draw().catch((error) => console.error(error));
  }
  working = false;
};

// Copy in which the value at a path of keys is another one; all other parts are those of the original.
const changed = (part, [key, ...further], value) => {
  const copy = Array.isArray(part) ? [...part] : {...part};
  copy[key] = further.length ? changed(part[key], further, value) : value;
  return copy;
};

export default {
  // Has its height before the figure is drawn, so that nothing moves then.
  template: `<div role="figure" :aria-label="label" :aria-busy="old ? 'true' : 'false'"
    :style="{ minHeight: height }"></div>`,
  props: { options: Object, revision: Number },
  emits: ["behind", "plotly_click"],
  data() {
    return { label: "", height: "", old: true };
  },
  created() {
    this.take();
  },
  mounted() {
    this.observer = new ResizeObserver(() => this.resized());
    this.observer.observe(this.$el);
  },
  beforeUnmount() {
    this.observer.disconnect();
    waiting.delete(this);
    if (this.drawn) Plotly.purge(this.$el);
  },
  watch: {
    revision() {
      this.take();
      this.later();
    },
  },
  methods: {
    // Takes over the figure of the properties, as plain data: Plotly reads it many times.
    take() {
      this.figure = Vue.toRaw(this.options);
      this.present = this.revision;
      this.look();
    },
    // Takes over changes of the figure with the revision before.
    change(revision, changes) {
      if (revision <= this.present) return;
      if (revision > this.present + 1) {
        this.$emit("behind");
        return;
      }
      for (const [path, value] of changes) this.figure = changed(this.figure, path, value);
      this.present = revision;
      this.look();
      this.later();
    },
    look() {
      this.label = this.figure.label;
      this.height = this.figure.data ? `${this.figure.layout.height}px` : "";
      this.old = true;
    },
    // Changes the layout in this browser only, such as the lines of a cut that follow a slider.
    relayout(places) {
      if (this.drawn) Plotly.relayout(this.$el, places);
    },
    later() {
      if (!this.figure.data || !shown(this.$el)) return;
      waiting.add(this);
      work();
    },
    // Is also called when a figure appears that was hidden.
    resized() {
      if (this.old) this.later();
      else if (this.drawn && shown(this.$el) && this.$el.clientWidth !== this.width) {
        this.width = this.$el.clientWidth;
        Plotly.Plots.resize(this.$el);
      }
    },
    async draw() {
      if (!shown(this.$el)) return;
      const {data, layout, ...further} = this.figure;
      const {present} = this;
      this.width = this.$el.clientWidth;
      // Plotly writes into traces and layouts.
      const own = {data: data.map((trace) => ({...trace})), layout: structuredClone(layout), ...further};
      await Plotly.react(this.$el, own);
      this.old = this.present !== present;
      if (this.drawn) return;
      this.drawn = true;
      this.$el.on("plotly_click", (event) => this.$emit("plotly_click", event));
    },
  },
};
