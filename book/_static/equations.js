// Sets the equations of a page: Sphinx leaves their TeX between \( \) or \[ \].
const MATH = /^\s*\\([([])([^]*)\\[)\]]\s*$/;

document.addEventListener("DOMContentLoaded", () => {
  if (!window.katex) return;
  const displayed = [];
  for (const place of document.querySelectorAll(".math")) {
    for (const piece of [...place.childNodes]) {
      const found = piece.nodeType === Node.TEXT_NODE && piece.data.match(MATH);
      if (!found) continue;
      const displayMode = found[1] === "[";
      const set = document.createElement("span");
      katex.render(found[2], set, { displayMode, throwOnError: false });
      piece.replaceWith(set);
      if (displayMode) displayed.push(set);
    }
  }
  // One that is wider than the screen scrolls, also by the keyboard.
  const reach = () => displayed.forEach((set) => {
    set.className = "equation";
    if (set.scrollWidth > set.clientWidth) set.tabIndex = 0;
    else set.removeAttribute("tabindex");
  });
  reach();
  document.fonts?.ready.then(reach);
  addEventListener("resize", reach);
});
