// Sets the equations of a page: Sphinx leaves their TeX between \( \) or \[ \].
const MATH = /^\s*\\([([])([^]*)\\[)\]]\s*$/;

document.addEventListener("DOMContentLoaded", () => {
  if (!window.katex) return;
  for (const place of document.querySelectorAll(".math")) {
    for (const piece of [...place.childNodes]) {
      const found = piece.nodeType === Node.TEXT_NODE && piece.data.match(MATH);
      if (!found) continue;
      const displayMode = found[1] === "[";
      const set = document.createElement("span");
      if (displayMode) set.className = "equation";
      katex.render(found[2], set, { displayMode, throwOnError: false });
      piece.replaceWith(set);
    }
  }
});
