// What is larger than its place scrolls there: reached by the keyboard, and with a shadow (see
// softgrip.css) where more of it lies to the side.
document.addEventListener("DOMContentLoaded", () => {
  const mark = (place) => {
    const wide = place.scrollWidth > place.clientWidth + 1;
    place.classList.toggle("scrolls", wide);
    if (wide || place.scrollHeight > place.clientHeight + 1) place.tabIndex = 0;
  };
  // Also when a fold opens, or the window is made smaller.
  const seen = new ResizeObserver((found) => found.forEach((one) => mark(one.target)));
  const places = document.querySelectorAll(".pst-scrollable-table-container, .equation, pre, "
    + ".cell_output .text_html, .more details > div");
  for (const place of places) seen.observe(place);
  document.fonts?.ready.then(() => places.forEach(mark)); // an equation is then another size
});
