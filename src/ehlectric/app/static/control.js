// Field of a form: label, slider, text box, list or search, help and error. Its text is local while it is typed.
const CUSTOM = "~own"; // entry that stands for values of one's own
const STEPS = 200;
const SHORT = 20; // characters
const THROTTLE = 100; // ms between two values of a dragged slider

export default {
  template: `
    <div v-if="shown" class="field" :class="{ wrong: !!error && !empty, listed: beside }" @keydown.esc="helped = false">
      <div class="field-head">
        <label :for="boxId">{{ label }}</label>
        <span v-if="note" class="field-note" :id="boxId + '-note'">{{ note }}</span>
        <span v-if="unit" class="unseen" :id="boxId + '-unit'">in {{ unit }}</span>
        <button v-if="help" type="button" class="help" :aria-expanded="helped ? 'true' : 'false'"
          :aria-controls="boxId + '-help'" :aria-label="'About ' + label" @click="helped = !helped">?</button>
      </div>
      <div class="field-row">
        <template v-if="kind === 'list'">
          <select :id="boxId" :value="text" v-bind="described" :data-testid="'field-' + testid" @change="choose($event.target.value)">
            <option v-for="o in options" :key="o.value" :value="o.value">{{ o.label }}</option>
          </select>
        </template>
        <div v-else-if="kind === 'search'" class="search">
          <input :id="boxId" ref="box" type="text" role="combobox" autocomplete="off" spellcheck="false"
            aria-autocomplete="list" :aria-expanded="opened ? 'true' : 'false'" :aria-controls="boxId + '-list'"
            :aria-activedescendant="opened && found[active] ? boxId + '-o' + active : null" v-bind="described"
            :data-testid="'field-' + testid" v-model="query" @focus="open" @click="open" @input="search"
            @keydown="keyed" @blur="leave">
          <div v-if="opened" :id="boxId + '-list'" ref="list" class="options" role="listbox" :aria-label="label" tabindex="-1">
            <div v-if="missing" class="options-none" role="status">{{ missing }}</div>
            <div v-for="g in groups" :key="g.name" role="group" :aria-label="g.name || label">
              <div v-if="g.name" class="options-name" aria-hidden="true">{{ g.name }}</div>
              <div v-for="o in g.options" :key="o.value" :id="boxId + '-o' + o.place" role="option"
                :aria-selected="o.value === text ? 'true' : 'false'" :class="{ active: o.place === active }"
                :data-testid="'option-' + o.value" @mousedown.prevent="pick(o)"
                @mousemove="active = o.place">{{ o.label }}</div>
            </div>
          </div>
        </div>
        <template v-else>
          <input v-if="slides" ref="slider" type="range" min="0" :max="steps" step="1" v-model.number="step"
            :class="{ unset: !text }" :aria-label="label + ', slider'" :aria-valuetext="local || placeholder || 'not given'"
            :data-testid="'slider-' + testid" @input="slide" @change="release">
          <input :id="boxId" ref="box" type="text" autocomplete="off" spellcheck="false" :class="{ long: !slides }"
            :placeholder="placeholder" :title="full || null" v-bind="described" :data-testid="'field-' + testid" v-model="local"
            @change="commit" @keydown.enter.prevent="commit" @keydown.esc="local = text">
        </template>
      </div>
      <p v-if="help && helped" class="field-help" :id="boxId + '-help'">{{ help }}</p>
      <p v-if="error" class="field-error" :class="{ empty: empty }" :role="empty ? 'status' : 'alert'" :id="boxId + '-error'" :data-testid="'error-' + testid">{{ error }}</p>
    </div>`,
  props: {
    boxId: String,
    testid: String,
    kind: { type: String, default: "number" },
    label: String,
    note: String,
    unit: String,
    help: String,
    error: String,
    // Whether the error is a value that is still to be typed.
    empty: { type: Boolean, default: false },
    shown: { type: Boolean, default: true },
    text: { type: String, default: "" },
    // Text with all digits, where that in the box is rounded.
    full: String,
    // Endings that a search may leave out, and what is told where it finds nothing.
    ignored: String,
    noMatch: String,
    // Whether a search takes a text that no entry has, as the designation of a bearing.
    free: { type: Boolean, default: false },
    turn: { type: Number, default: 0 },
    place: { type: Number, default: 0 },
    slides: { type: Boolean, default: false },
    placeholder: String,
    options: { type: Array, default: () => [] },
  },
  data() {
    return {
      local: this.text,
      step: Math.round(this.place * STEPS),
      steps: STEPS,
      held: false,
      helped: false,
      opened: false,
      moved: false,
      query: "",
      typed: false,
      active: 0,
    };
  },
  mounted() {
    this.query = this.labelOf(this.text);
  },
  beforeUnmount() {
    clearTimeout(this.timer);
  },
  watch: {
    text() {
      this.local = this.text;
      if (!this.opened) this.query = this.labelOf(this.text);
    },
    turn() {
      this.local = this.text;
      if (!this.opened) this.query = this.labelOf(this.text);
    },
    options() {
      if (!this.opened) this.query = this.labelOf(this.text);
    },
    place() {
      if (!this.held) this.step = Math.round(this.place * STEPS);
    },
  },
  computed: {
    // A list with short entries stands beside its label.
    beside() {
      return this.kind === "list" && this.options.every((o) => o.label.length <= SHORT);
    },
    described() {
      const by = [this.unit && "-unit", this.note && "-note", this.help && this.helped && "-help", this.error && "-error"]
        .filter(Boolean)
        .map((end) => this.boxId + end);
      return { "aria-invalid": this.error && !this.empty ? "true" : null, "aria-describedby": by.join(" ") || null };
    },
    matches() {
      const query = this.typed ? this.query.toLowerCase() : "";
      const found = this.matching(query);
      if (found.length || !this.ignored) return found;
      const bare = this.bare(query);
      return /\d/.test(bare) ? this.matching(bare) : found;
    },
    // Ending of the typed name that no entry has, such as a class of clearance: it is sent with the entry.
    ending() {
      const query = this.typed ? this.query.trim() : "";
      if (!this.ignored || this.matching(query.toLowerCase()).length) return "";
      return query.slice(this.bare(query.toLowerCase()).length);
    },
    // Whether Enter takes the typed text, a designation, and no entry that only contains its words.
    named() {
      return this.free && this.typed && !this.moved && /\d/.test(this.query);
    },
    found() {
      // Where nothing is found, the entry for own values stays.
      const found = this.matches.length ? this.matches : this.options.filter((o) => o.value === CUSTOM);
      return found.map((o, place) => ({ ...o, place }));
    },
    missing() {
      if (this.matches.length) return "";
      const count = this.options.filter((o) => o.value && o.value !== CUSTOM).length;
      return (this.noMatch || "nothing found").replace("{count}", count);
    },
    groups() {
      const groups = [];
      for (const option of this.found) {
        let group = groups.find((g) => g.name === option.group);
        if (!group) groups.push((group = { name: option.group, options: [] }));
        group.options.push(option);
      }
      return groups;
    },
  },
  methods: {
    bare(query) {
      return query.replace(new RegExp(this.ignored), "");
    },
    matching(query) {
      const words = query.split(/\s+/).filter(Boolean);
      const text = (o) => (o.value + " " + o.label + " " + o.group).toLowerCase();
      // One or two letters of a designation, such as a contact angle, are in nearly every label.
      const where = (o, word) => (this.free && /^[a-z]{1,2}$/.test(word) ? o.value.toLowerCase() : text(o));
      return this.options.filter((o) => words.every((word) => where(o, word).includes(word)));
    },
    labelOf(value) {
      const found = this.options.find((o) => o.value === value);
      return found ? found.label : value;
    },
    commit() {
      if (this.local.trim() === this.text) return;
      this.$emit("commit", this.local);
    },
    slide() {
      this.held = true;
      const wait = THROTTLE - (Date.now() - (this.sent || 0));
      clearTimeout(this.timer);
      if (wait <= 0) this.send();
      else this.timer = setTimeout(this.send, wait);
    },
    send() {
      clearTimeout(this.timer);
      this.sent = Date.now();
      this.last = this.step;
      this.$emit("slide", this.step / STEPS);
    },
    release() {
      if (this.held && this.last !== this.step) this.send();
      this.held = false;
      this.last = null;
    },
    pick(option) {
      this.choose(option.value === CUSTOM ? CUSTOM : option.value + this.ending);
    },
    choose(value) {
      this.opened = false;
      this.typed = false;
      this.query = this.labelOf(value);
      if (value !== this.text) this.$emit("commit", value);
    },
    open() {
      if (this.opened) return;
      this.opened = true;
      this.typed = false;
      this.active = Math.max(0, this.found.findIndex((o) => o.value === this.text));
      this.$refs.box.select();
      this.seen();
    },
    search() {
      this.opened = true;
      this.typed = true;
      this.moved = false;
      this.active = this.matches.length ? 0 : -1;
    },
    close() {
      this.opened = false;
      this.typed = false;
      this.query = this.labelOf(this.text);
    },
    // Takes a typed text that means one entry, or none, which the server refuses; drops words of a search.
    leave() {
      const typed = this.typed ? this.query.trim() : "";
      const same = (o) => [o.value, o.label].some((text) => text.toLowerCase() === typed.toLowerCase());
      const entry = this.options.find(same) || (this.matches.length === 1 && this.matches[0]);
      if (!typed) this.close();
      else if (this.named) this.choose(typed);
      else if (entry) this.pick(entry);
      else if (!this.matches.length) this.choose(typed);
      else this.close();
    },
    keyed(event) {
      if (event.key === "ArrowDown" || event.key === "ArrowUp") {
        event.preventDefault();
        if (!this.opened) return this.open();
        const step = event.key === "ArrowDown" ? 1 : -1;
        const count = this.found.length;
        this.moved = true;
        if (count) this.active = this.active < 0 ? 0 : (this.active + step + count) % count;
        this.seen();
      } else if (event.key === "Enter") {
        event.preventDefault();
        if (this.opened && this.named) this.choose(this.query.trim());
        else if (this.opened && this.found[this.active]) this.pick(this.found[this.active]);
        else if (this.opened && this.free && this.query.trim()) this.choose(this.query.trim());
        else this.open();
      } else if (event.key === "Escape") {
        this.close();
      }
    },
    seen() {
      this.$nextTick(() => {
        const option = this.$refs.list?.querySelector(".active");
        if (option) option.scrollIntoView({ block: "nearest" });
      });
    },
  },
};
