// Movie of a contact: shows an instant of a figure with frames, and its time in another figure.
// Everything happens in the browser, so that the slider follows at once.
(({movie, history, slider, text, play, times, texts, first}) => {
  const at = (id) => document.getElementById(id);
  const ready = () => [movie, history].every((id) => at(id) && at(id)._fullLayout);
  const rate = 12;
  let present = 0, timer = null, drawing = false, wanted = null;

  const begin = async () => {
    const {Plotly} = await import("nicegui-plotly");
    const draw = async () => {
      if (drawing) return;
      drawing = true;
      while (wanted !== null) {
        const frame = wanted;
        wanted = null;
        if (!at(movie)) { stop(); break; }
        const still = {mode: "immediate", frame: {duration: 0, redraw: true}, transition: {duration: 0}};
        await Plotly.animate(at(movie), [String(frame)], still).catch(() => null);
        await Plotly.relayout(at(history), {"shapes[0].x0": times[frame], "shapes[0].x1": times[frame]});
      }
      drawing = false;
    };
    const show = (frame) => {
      present = Math.min(Math.max(frame, 0), times.length - 1);
      at(slider).value = present;
      at(slider).setAttribute("aria-valuetext", texts[present]);
      at(text).textContent = texts[present];
      wanted = present;
      draw();
    };
    const stop = () => {
      clearInterval(timer);
      timer = null;
      if (at(play)) { at(play).textContent = "Play"; at(play).setAttribute("aria-pressed", "false"); }
    };
    const start = () => {
      at(play).textContent = "Pause";
      at(play).setAttribute("aria-pressed", "true");
      if (present === times.length - 1) show(0);
      timer = setInterval(() => {
        if (!at(movie) || present === times.length - 1) { stop(); return; }
        show(present + 1);
      }, 1000 / rate);
    };
    at(slider).addEventListener("input", (event) => { stop(); show(Number(event.target.value)); });
    at(play).addEventListener("click", () => (timer === null ? start() : stop()));
    at(slider).addEventListener("instant", (event) => { stop(); show(event.detail); });
    at(history).on("plotly_click", (event) => {
      const time = event.points[0].x;
      const away = times.map((one) => Math.abs(one - time));
      stop();
      show(away.indexOf(Math.min(...away)));
    });
    show(first);
  };
  // A busy browser draws late: the slider is there for as long as the page shows the movie.
  const wait = (left) =>
    ready() ? begin() : (at(slider) || left > 0) && setTimeout(() => wait(left - 1), 50);
  wait(200);
})
