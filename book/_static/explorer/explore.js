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
  const from = (found, what) => {
    const numbers = typeof what === "string" ? found[what] : what;
    return typeof numbers === "number" ? [numbers] : numbers;
  };

  // Of the sample that is shown at a moment; the last one without a moment.
  const placed = (times, moment) => {
    const k = moment === undefined ? -1 : times.findIndex((t) => t >= moment);
    return k < 0 ? times.length - 1 : k;
  };

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
    bent: (P, m, f) => {
      const angle = from(f, m.angle), times = from(f, m.times)[0], length = from(f, m.length)[0];
      const turn = (angle[m.time ? placed(from(f, m.time), f.moment) : angle.length - 1] * times * Math.PI) / 180;
      const x = Array.from(from(f, m.x)), y = Array.from(from(f, m.y)), side = m.mirrored ? -1 : 1, out = [];
      x.forEach((begin, k) => { // edges in parts so short that they can be bent
        const next = (k + 1) % x.length, parts = Math.ceil(Math.abs(x[next] - begin) / 2) || 1;
        for (let j = 0; j < parts; j++) {
          const s = begin + ((x[next] - begin) * j) / parts, high = y[k] + ((y[next] - y[k]) * j) / parts;
          const half = (turn * s) / length / 2, chord = Math.abs(half) < 1e-9 ? s : (s * Math.sin(half)) / half;
          const along = chord * Math.cos(half) + high * Math.sin(2 * half);
          const up = side * (high * Math.cos(2 * half) - chord * Math.sin(half));
          out.push(m.hanging === null ? [along, up] : [m.hanging + up, -along]);
        }
      });
      return P.line(out, { curve: "linear-closed", stroke: "currentColor", strokeWidth: 1,
        fill: m.colour, fillOpacity: 0.85, className: "bent" });
    },
    dimension: (P, m, f) => {
      const x = from(f, m.x), y = from(f, m.y), last = (v) => v[v.length - 1];
      const middle = [[(x[0] + last(x)) / 2, (y[0] + last(y)) / 2]], level = y[0] === last(y);
      return [
        P.link([0], { x1: x[0], y1: y[0], x2: last(x), y2: last(y), stroke: colour(m.colour), strokeWidth: 1,
          markerStart: "arrow-reverse", markerEnd: "arrow" }),
        P.text(middle, { text: () => m.text, fill: colour(m.colour), fontStyle: "italic", fontSize: 14,
          ...(level ? { dy: -9 } : { dx: 5, textAnchor: "start" }) }),
      ];
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
    const share = room >= 520 ? panel.share : panel.bare ? 0.6 : 1;
    const wide = Math.max(150, Math.min(room, 700) * share - 6);
    const found_marks = panel.marks.flatMap((m) => marks[m.kind](P, m, found, panel));
    if (found.moment !== undefined && !panel.bare) found_marks.push(P.ruleX([found.moment], { stroke: "currentColor", clip: true }));
    const options = {
      width: wide, height: panel.height, marginLeft: panel.left, marginRight: 14, marginTop: 22, marginBottom: 40,
      style: { fontSize: "12px", overflow: "hidden" },
      x: { domain: panel.x, label: panel.x_label || null, ticks: Math.max(3, Math.round(wide / 90)), labelArrow: "none" },
      y: { domain: panel.y, label: panel.y_label || null, labelArrow: "none", ...(words ? { padding: 0.3 } : { ticks: 5 }) },
      marks: [P.gridX({ ticks: 5 }), ...(words ? [] : [P.gridY({ ticks: 5 })]), ...found_marks],
    };
    if (panel.bare) {
      options.marginLeft = options.marginRight = options.marginBottom = 4;
      options.x.axis = options.y.axis = null;
      options.marks = found_marks;
    }
    if (panel.equal) {
      if (!panel.bare) options.marginBottom += 4; // letters below the line, at a broken height
      const across = wide - options.marginLeft - options.marginRight;
      const tall = across * (panel.y[1] - panel.y[0]) / (panel.x[1] - panel.x[0]);
      options.height = tall + options.marginTop + options.marginBottom;
    }
    const plot = P.plot(options);
    // The figure says in words what it shows; a name that Plot gives to a group without a role is none.
    plot.querySelectorAll("g[aria-label]").forEach((group) => group.removeAttribute("aria-label"));
    return plot;
  }

  // A table of all curves: a column for each array that a mark takes.
  function table(plot, found) {
    const columns = new Map();
    for (const panel of plot.panels) for (const m of panel.marks) for (const key of ["x", "y", "low", "high", "at", "marked", "angle"])
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
    // What moves by itself, and how long, s.
    const moving = it.plot?.panels.flatMap((p) => p.marks).find((m) => m.time)?.time;
    let asked = 0, playing = 0, shown, moment;

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
        image.alt = [it.alt, ...state, it.told[index]].join("; ");
        part("told").textContent = it.told[index];
      } else {
        const found = Object.assign(Object.fromEntries(it.sliders.map((s, i) => [s.name, now[i]])), compute(now));
        const hit = it.plot.cases.find(([name]) => found[name][0]);
        const title = told(hit ? hit[1] : it.plot.title, found);
        part("told").textContent = title;
        shown = found;
        paint();
        part("panels").setAttribute("aria-label", [it.alt, ...state, title].join("; "));
        if (part("values").open) part("values").lastElementChild.replaceChildren(table(it.plot, found));
      }
      const moved = it.sliders.map((s, i) => [s, now[i]]).filter(([s, value]) => !it.show || value !== s.begin);
      part("call").textContent = `${it.call}(${moved.map(([s, value]) => `${s.name}=${JSON.stringify(value)}`).join(", ")})`;
      part("link").href = `#${id}?${moved.map(([s, value]) => `${s.name}=${encodeURIComponent(value)}`).join("&")}`;
    }
    function paint() {
      const room = part("panels").clientWidth || 640;
      part("panels").replaceChildren(...it.plot.panels.map((panel) => drawn(panel, { ...shown, moment }, room)));
    }
    // In the time that the real one would take.
    function play() {
      const begin = performance.now(), mine = ++playing;
      const next = (now) => {
        if (mine !== playing) return;
        moment = Math.max(0, (now - begin) / 1000);
        if (moment >= shown[moving][shown[moving].length - 1]) moment = undefined;
        paint();
        if (moment !== undefined) requestAnimationFrame(next);
      };
      requestAnimationFrame(next);
    }
    // One picture a frame, however fast the slider moves.
    const ask = () => { asked ||= requestAnimationFrame(draw); };

    function put(places) {
      playing++; // what plays ends
      moment = undefined;
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
    part("reset").addEventListener("click", () => put(beginning));
    part("play")?.addEventListener("click", play);
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
