// Undo and redo by keys, unless they belong to a text that is being typed.
document.addEventListener("keydown", event => {
  const key = event.key.toLowerCase();
  if (!(event.ctrlKey || event.metaKey) || event.altKey || (key !== "z" && key !== "y")) return;
  const focus = document.activeElement;
  const typed = focus && focus.tagName === "INPUT" && !focus.readOnly
    && !["range", "checkbox", "radio", "button"].includes(focus.type);
  if (typed || (focus && (focus.isContentEditable || focus.tagName === "TEXTAREA"))) return;
  const name = key === "y" || event.shiftKey ? "redo" : "undo";
  const button = document.querySelector(`[data-testid="${name}"]`);
  if (!button || button.disabled) return;
  event.preventDefault();
  button.click();
});
