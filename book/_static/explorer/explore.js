// Figures whose sliders compute. A page holds, for each, what book/explore wrote: sliders, plot and
// the law as JavaScript, or frames that were drawn ahead, or what it shows by itself (`show`, told
// the sliders' values). Nothing is asked of a network or a kernel.
(() => {
  const all = (window.softgripExplorers ||= {});
  const written = (number) => String(number).replace("-", "\u2212");

  // A slider has whole steps; a decimal number stands for each, the one that is shown and computed.
  function valueAt(s, place) {
    if (s.values) return s.values[place];
    if (place === s.start) return s.begin; // which may lie between two steps
    if (s.log) return +(s.low * (s.high / s.low) ** (place / s.steps)).toPrecision(3);
    return +(s.low + ((s.high - s.low) * place) / s.steps).toPrecision(12);
  }
  function placeOf(s, value) {
    if (s.values) return Math.max(0, s.values.findIndex((v) => String(v) === String(value)));
    const part = s.log ? Math.log(value / s.low) / Math.log(s.high / s.low) : (value - s.low) / (s.high - s.low);
    return Math.min(s.steps, Math.max(0, Math.round(part * s.steps))) || 0;
  }

  function told(template, found) {
    return template.replace(/\{(\w+)(?::([^}]*))?\}/g, (_, name, format) => {
      const value = found[name];
      return typeof value === "string" ? value : window.d3.format(format ?? "")(value.length === undefined ? value : value[0]);
    });
  }

  const colour = (name) => (name === "#000000" ? "currentColor" : name);
  const from = (found, what) =>
    typeof what === "string" ? found[what] : typeof what === "number" ? [what] : what;

  // Marks of Observable Plot for a mark of book/explore/plot.py.
  const marks = {
    line: (P, m, f) => {
      const x = from(f, m.x), y = from(f, m.y);
      return P.line(x, { x, y, stroke: colour(m.colour), strokeWidth: m.width,
        strokeDasharray: m.dash || null, curve: m.step ? "step-after" : "linear", clip: true });
    },
    band: (P, m, f, panel) => {
      const wide = m.x === "", x = wide ? panel.x : from(f, m.x);
      const low = from(f, m.low), high = from(f, m.high);
      return P.areaY(x, { x, y1: wide ? x.map(() => low[0]) : low, y2: wide ? x.map(() => high[0]) : high,
        fill: colour(m.colour), fillOpacity: 0.18, clip: true });
    },
    span: (P, m, f) => P.rectX([0], { x1: from(f, m.low)[0], x2: from(f, m.high)[0],
      fill: colour(m.colour), fillOpacity: 0.18, clip: true }),
    level: (P, m, f) => (m.axis === "y" ? P.ruleY : P.ruleX)(from(f, m.at), { stroke: colour(m.colour),
      strokeWidth: m.width, strokeDasharray: m.dash || null, clip: true }),
    outline: (P, m, f) => {
      let x = Array.from(from(f, m.x)), y = Array.from(from(f, m.y));
      if (m.mirrored) [x, y] = [[...x, ...x.map((v) => -v).reverse()], [...y, ...y.slice().reverse()]];
      return P.line(x, { x, y, curve: "linear-closed", stroke: colour(m.colour), strokeWidth: 1.8,
        strokeDasharray: m.dash || null, fill: m.fill ? colour(m.colour) : "none", fillOpacity: m.fill, clip: true });
    },
    dots: (P, m, f) => {
      const x = from(f, m.x), y = typeof m.y[0] === "string" && Array.isArray(m.y) ? m.y : from(f, m.y);
      return P.dot(x, { x, y, r: m.radius, fill: colour(m.colour), clip: true });
    },
    bars: (P, m, f, panel) => {
      const x = from(f, m.x), marked = from(f, m.marked);
      return P.barX(m.names, { x: Array.from(x, (v) => Math.min(v, panel.x[1])), y: m.names,
        fill: Array.from(marked, (v) => colour(v ? m.colour : m.other)) });
    },
  };

  function drawn(asked, found, room) {
    const ends = (axis) => axis.map((end) => (typeof end === "string" && found[end] ? found[end][0] : end));
    const panel = { ...asked, x: ends(asked.x), y: ends(asked.y) };
    const P = window.Plot, words = typeof panel.y[0] === "string";
    const wide = Math.max(150, Math.min(room, 700) * (room < 520 ? 1 : panel.share) - 6);
    const found_marks = panel.marks.map((m) => marks[m.kind](P, m, found, panel));
    const options = {
      width: wide, height: panel.height, marginLeft: panel.left, marginRight: 14, marginTop: 22, marginBottom: 40,
      style: { fontSize: "12px", overflow: "hidden" },
      x: { domain: panel.x, label: panel.x_label || null, ticks: Math.max(3, Math.round(wide / 90)), labelArrow: "none" },
      y: { domain: panel.y, label: panel.y_label || null, labelArrow: "none", ...(words ? { padding: 0.3 } : { ticks: 5 }) },
      marks: [P.gridX({ ticks: 5 }), ...(words ? [] : [P.gridY({ ticks: 5 })]), ...found_marks],
    };
    if (panel.equal) {
      const tall = (wide - panel.left - 14) * (panel.y[1] - panel.y[0]) / (panel.x[1] - panel.x[0]);
      options.height = tall + 62;
    }
    return P.plot(options);
  }

  // A table of all curves: a column for each array that a mark takes.
  function table(plot, found) {
    const columns = new Map();
    for (const panel of plot.panels) for (const m of panel.marks) for (const key of ["x", "y", "low", "high", "at", "marked"])
      if (typeof m[key] === "string" && found[m[key]]) columns.set(m[key], found[m[key]]);
    const rows = Math.max(...Array.from(columns.values(), (c) => c.length));
    const made = document.createElement("table"), head = made.createTHead().insertRow();
    for (const name of columns.keys()) {
      const cell = document.createElement("th");
      cell.scope = "col";
      cell.textContent = name.replaceAll("_", " ");
      head.append(cell);
    }
    const body = made.createTBody();
    for (let k = 0; k < rows; k++) {
      const row = body.insertRow();
      for (const c of columns.values()) row.insertCell().textContent = k < c.length ? written(+c[k].toPrecision(6)) : "";
    }
    return made;
  }

  function start(id) {
    const it = all[id], root = document.getElementById(id);
    if (!root || root.dataset.started) return;
    root.dataset.started = "yes";
    const part = (name) => root.querySelector(`.${name}`);
    const controls = it.sliders.map((s) => root.querySelector(`[name="${s.name}"]`));
    const beginning = it.sliders.map((s) => s.start);
    const values = () => it.sliders.map((s, i) => valueAt(s, +controls[i].value));
    let asked = 0;

    function compute(now) {
      const words = it.sliders.flatMap((s, i) => (typeof now[i] === "string" ? [now[i]] : []));
      return it.laws[words.join("|")](now.filter((v) => typeof v !== "string"));
    }

    function draw() {
      asked = 0;
      const now = values();
      const state = it.sliders.map((s, i) => {
        const text = `${typeof now[i] === "string" ? now[i] : written(now[i])} ${s.unit}`.trim();
        controls[i].setAttribute("aria-valuetext", text);
        controls[i].parentElement.querySelector("output").textContent = text;
        return `${s.label} ${text}`;
      });
      if (it.show) it.show(root, now);
      else if (it.frames) {
        const index = it.sliders.reduce((at, s, i) => at * s.values.length + +controls[i].value, 0);
        const image = part("panels").firstElementChild;
        image.src = it.frames[index];
        image.alt = [it.alt, ...state].join("; ");
      } else {
        const found = Object.assign(Object.fromEntries(it.sliders.map((s, i) => [s.name, now[i]])), compute(now));
        const hit = it.plot.cases.find(([name]) => found[name][0]);
        const title = told(hit ? hit[1] : it.plot.title, found);
        part("told").textContent = title;
        const room = part("panels").clientWidth || 640;
        part("panels").replaceChildren(...it.plot.panels.map((panel) => drawn(panel, found, room)));
        part("panels").setAttribute("aria-label", [it.alt, ...state, title].join("; "));
        if (part("values").open) part("values").lastElementChild.replaceChildren(table(it.plot, found));
      }
      const moved = it.sliders.map((s, i) => [s, now[i]]).filter(([s, value]) => !it.show || value !== s.begin);
      part("call").textContent = `${it.call}(${moved.map(([s, value]) => `${s.name}=${JSON.stringify(value)}`).join(", ")})`;
      part("link").href = `#${id}?${moved.map(([s, value]) => `${s.name}=${encodeURIComponent(value)}`).join("&")}`;
    }
    // One picture a frame, however fast the slider moves.
    const ask = () => { asked ||= requestAnimationFrame(draw); };

    function put(places) {
      controls.forEach((control, i) => { control.value = places[i]; });
      draw();
    }
    function fromAddress(scroll) {
      const [name, query] = location.hash.slice(1).split("?");
      if (name !== id || !query) return false;
      const given = new URLSearchParams(query);
      put(it.sliders.map((s, i) => (given.has(s.name) ? placeOf(s, s.values ? given.get(s.name) : +given.get(s.name)) : beginning[i])));
      if (scroll) root.scrollIntoView();
      return true;
    }

    for (const control of controls) control.addEventListener("input", ask);
    // All frames are fetched when one is wanted, so that the next is there at once.
    root.addEventListener("pointerenter", () => it.frames?.forEach((src) => { new Image().src = src; }), { once: true });
    root.querySelector("button").addEventListener("click", () => put(beginning));
    part("values")?.addEventListener("toggle", draw);
    addEventListener("hashchange", () => fromAddress(true));
    // Paper shows where the sliders began.
    let before;
    addEventListener("beforeprint", () => { before = controls.map((c) => c.value); put(beginning); });
    addEventListener("afterprint", () => put(before));
    if (it.plot) {
      let wide = 0;
      new ResizeObserver(([entry]) => {
        if (Math.abs(entry.contentRect.width - wide) > 1) { wide = entry.contentRect.width; ask(); }
      }).observe(part("panels"));
    }
    if (!fromAddress(true)) put(beginning);
  }

  // What draws comes after this script, and a figure perhaps before its page is read.
  const startAll = () => Object.keys(all).filter((id) => all[id].show || (window.d3 && window.Plot)).forEach(start);
  const ready = () => document.readyState !== "loading";
  window.softgripExplore = () => { if (ready()) startAll(); };
  if (ready()) startAll();
  else addEventListener("DOMContentLoaded", startAll);
})();
