// Group of fields that opens and closes; a group of optional inputs has a switch.
const NARROW = 860; // pixels, as in the style sheet

export default {
  template: `
    <details ref="details" class="group" :data-testid="'group-' + testid">
      <summary><span class="group-title">{{ title }}</span><span v-if="about" class="group-about">{{ about }}</span><span v-if="switches && !on" class="group-off">off</span></summary>
      <div class="group-body">
        <label v-if="switches" class="switch">
          <input type="checkbox" :checked="on" :data-testid="'switch-' + testid" @change="$emit('switch', $event.target.checked)">
          Include {{ title.toLowerCase() }}
        </label>
        <p v-if="note && (on || !switches)" class="field-help">{{ note }}</p>
        <slot></slot>
        <p v-if="tells" class="field-help" :data-testid="'tells-' + testid">{{ tells }}</p>
      </div>
    </details>`,
  props: {
    title: String,
    testid: String,
    note: String,
    // Short text about what the group contains.
    about: String,
    tells: String,
    // Whether the group is opened on a narrow screen, too.
    first: { type: Boolean, default: false },
    opened: { type: Boolean, default: true },
    turn: { type: Number, default: 0 },
    switches: { type: Boolean, default: false },
    on: { type: Boolean, default: true },
  },
  mounted() {
    this.$refs.details.open = this.opened && (this.first || window.innerWidth > NARROW);
  },
  watch: {
    turn() {
      this.$refs.details.open = this.opened;
    },
  },
};
