// The sliders' handles have no accessible name, and tell their index in place of their value.
(function () {
  function name(slider) {
    const handle = slider.querySelector(".noUi-handle");
    const label = slider.querySelector(".widget-label");
    const readout = slider.querySelector(".widget-readout");
    if (!handle || !label || !readout || handle.hasAttribute("aria-label")) return;
    handle.setAttribute("aria-label", label.textContent);
    readout.removeAttribute("contenteditable");
    const tell = () => handle.setAttribute("aria-valuetext", readout.textContent);
    new MutationObserver(tell).observe(readout, { childList: true, characterData: true, subtree: true });
    tell();
  }
  const all = () => document.querySelectorAll(".widget-hslider").forEach(name);
  document.addEventListener("DOMContentLoaded", function () {
    // The widget manager calls MathJax 2, which is not there; no widget here holds an equation.
    if (window.MathJax && !window.MathJax.Hub) window.MathJax.Hub = { Queue: function () {} };
    if (!document.querySelector('script[type="application/vnd.jupyter.widget-view+json"]')) return;
    new MutationObserver(all).observe(document.body, { childList: true, subtree: true });
    all();
  });
})();
