// Choice between the colours of the system, light and dark. The browser keeps it.
const KEY = "ehlectric-theme";
const THEMES = ["auto", "light", "dark"];
const NAMES = { auto: "Auto", light: "Light", dark: "Dark" };

export default {
  template: `<button type="button" class="theme" data-testid="theme" :aria-label="'Colours: ' + names[theme]"
    @click="next"><span aria-hidden="true">◐</span> {{ names[theme] }}</button>`,
  data() {
    return { theme: "auto", names: NAMES };
  },
  mounted() {
    const kept = window.localStorage.getItem(KEY);
    this.theme = THEMES.includes(kept) ? kept : "auto";
    this.apply();
  },
  methods: {
    next() {
      this.theme = THEMES[(THEMES.indexOf(this.theme) + 1) % THEMES.length];
      window.localStorage.setItem(KEY, this.theme);
      this.apply();
    },
    apply() {
      this.$q.dark.set(this.theme === "auto" ? "auto" : this.theme === "dark");
    },
  },
};
