// Sends the arrow keys and Enter on a map.
(event) => {
  if (["ArrowLeft", "ArrowRight", "ArrowUp", "ArrowDown", "Enter"].includes(event.key)) {
    event.preventDefault(); emit(event.key);
  }
}
