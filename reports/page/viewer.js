// A large picture of a query. The reader can turn the picture, zoom in on the contact, and run through the
// step. Beside the picture are plots over time.
"use strict";

/** A number of a certificate: a hexadecimal double, an integer or a fraction. */
function certificateNumber(text) {
  const hex = /^(-?)0x([0-9a-f]+)\.?([0-9a-f]*)p([-+]?\d+)$/i.exec(text);
  if (hex) return (hex[1] ? -1 : 1) * parseInt(hex[2] + hex[3], 16) * 2 ** (Number(hex[4]) - 4 * hex[3].length);
  const [p, q = "1"] = text.split("/");
  const digits = q.length + 20;
  return Number((BigInt(p) * 10n ** BigInt(digits)) / BigInt(q)) / 10 ** digits;
}

/**
 * Returns a function of the time. If the certificate puts a plane between the primitives at a time, the
 * function returns the plane's unit normal at this time; otherwise it returns undefined.
 */
function normalOf(certificate) {
  const { times, normals } = certificate ? JSON.parse(certificate) : {};
  if (!normals) return () => undefined;
  const ends = times.map(certificateNumber);
  const polynomials = normals.map((each) => each.map((coefficients) => coefficients.map(certificateNumber)));
  return (t) => {
    if (t < ends[0] || t > ends.at(-1)) return undefined;
    const piece = polynomials[Math.max(0, Math.min(normals.length, ends.findIndex((end, i) => i > 0 && t <= end)) - 1)];
    const normal = piece.map((coefficients) => coefficients.reduceRight((sum, c) => sum * t + c, 0));
    const length = Math.hypot(...normal);
    return length > 0 && length < Infinity ? normal.map((c) => c / length) : undefined;
  };
}

/**
 * For each kind, a function that computes the values in the plots from the places of a query's vertices. For
 * vt and ee, it returns F, the volume that the vertices span, which is 0 if they are coplanar. For vv and ve,
 * it returns the distance of the closest points. For all kinds except vv, it also returns the barycentric
 * weights, multiplied by `norm`.
 */
const curves = {
  vt: ([x0, x1, x2, x3]) => {
    const n = cross(minus(x2, x1), minus(x3, x1));
    const weight = (p, q) => dot(n, cross(minus(p, x0), minus(q, x0)));
    return { F: dot(n, minus(x0, x1)), norm: dot(n, n), weights: { x1: weight(x2, x3), x2: weight(x3, x1), x3: weight(x1, x2) } };
  },
  ee: ([x0, x1, x2, x3]) => {
    const [d, e, r] = [minus(x1, x0), minus(x3, x2), minus(x2, x0)];
    const n = cross(d, e);
    const [s, u] = [dot(n, cross(r, e)), dot(n, cross(r, d))];
    const norm = dot(n, n);
    return { F: dot(n, r), norm, weights: { x0: norm - s, x1: s, x2: norm - u, x3: u } };
  },
  vv: ([x0, x1]) => ({ distance: Math.hypot(...minus(x0, x1)), weights: {} }),
  ve: ([x0, x1, x2]) => {
    const [e, r] = [minus(x2, x1), minus(x0, x1)];
    const s = Math.min(1, Math.max(0, dot(r, e) / dot(e, e) || 0));
    return { distance: Math.hypot(...minus(x0, along(x1, x2, s))), norm: dot(e, e), weights: { x1: dot(e, e) - dot(r, e), x2: dot(r, e) } };
  },
};

const plotSize = [300, 110];
/**
 * A plot of curves over time.
 * @param lines [{name, values}], with values at equal steps of time
 * @param range [lowest, highest] value shown
 * @param marks vertical lines [{at: place as a part of the plot's width, name}]
 * @param levels values at which a horizontal line is drawn
 */
function drawPlot(svg, lines, [lowest, highest], marks, levels) {
  const [width, height] = plotSize;
  const y = (value) => 4 + (height - 8) * (1 - (value - lowest) / (highest - lowest));
  const across = (value) => svgMade("line", { x1: 0, x2: width, y1: y(value), y2: y(value), class: "level" });
  const line = ({ values }, which) => svgMade("path", { class: `line${which}`, d: values.map((value, i) =>
    (Number.isFinite(value) ? `${Number.isFinite(values[i - 1]) ? "L" : "M"}${((i * width) / (values.length - 1)).toFixed(1)} ${Math.min(2 * height, Math.max(-height, y(value))).toFixed(1)}` : "")).join("") });
  svg.replaceChildren(...levels.map(across), ...lines.map(line),
    ...marks.filter(({ at }) => at >= 0 && at <= 1).map(({ at, name }) => svgMade("line", { x1: at * width, x2: at * width, y1: 0, y2: height, class: name })));
}

/** The plots of a query, and a function that draws them for a span of time and marks the time `now`. */
function makePlots({ kind, query, time, toi }) {
  const { at, unit } = scaledQuery(query);
  const first = curves[kind](at(0));
  const isVolume = first.F !== undefined;
  const names = Object.keys(first.weights);
  const box = (title, names) => {
    const svg = svgMade("svg", { viewBox: `0 0 ${plotSize.join(" ")}`, class: "plot", role: "img", "aria-label": `${title} over the step` });
    const legend = names.map((name, i) => [made("span", "", { class: `swatch line${i}` }), ` ${name} `]).flat();
    return { svg, node: made("div", [made("div", [title, " ", ...legend], { class: "small" }), svg]) };
  };
  const boxes = [box(isVolume ? "F, 0 if the vertices are coplanar" : "distance; the line is h", []),
    ...(names.length > 0 ? [box("barycentric weights, inside if between 0 and 1", names)] : [])];
  const span = small("");
  function draw(now, [from, to]) {
    const samples = Array.from({ length: 121 }, (_, i) => curves[kind](at(from + ((to - from) * i) / 120)));
    const marks = [[time, "moment"], [toi, "given"], [now, "now"]].map(([t, name]) => ({ at: (t - from) / (to - from), name }));
    const values = samples.map((each) => (isVolume ? each.F : unit * each.distance));
    const levels = [isVolume ? 0 : separationOf(query)];
    const around = to - from < 1;
    span.textContent = `from t = ${around && from > 0 ? `t* − ${short(time - from)}` : "0"} to ${around && to < 1 ? `t* + ${short(to - time)}` : "1"}; ` +
      `red: t* or closest; ${toi === undefined ? "" : "dashed: toi; "}grey: t`;
    const most = Math.max(...values.map(Math.abs)) || 1;
    drawPlot(boxes[0].svg, [{ values }], isVolume ? [-most, most] : [0, Math.max(most, ...levels)], marks, levels);
    if (names.length > 0) drawPlot(boxes[1].svg, names.map((name) => ({ values: samples.map(({ weights, norm }) => weights[name] / norm) })), [-0.5, 1.5], marks, [0, 1]);
  }
  return { nodes: [...boxes.map(({ node }) => node), span], draw };
}

const isStill = matchMedia("(prefers-reduced-motion: reduce)").matches;

/**
 * A large picture of a query with its controls, and plots.
 * @param shown the `shown` of makePicture; it may also have a certificate
 * @returns a figure, and a list of plots
 */
function makeViewer(shown) {
  const picture = makePicture(shown, [640, 480]);
  const plots = makePlots(shown);
  const normal = normalOf(shown.certificate);
  const start = { yaw: -0.6, pitch: 0.5, zoom: 1, time: shown.time };
  const view = { ...start, frame: 0 };
  const slider = made("input", [], { type: "range", min: "0", max: "1", step: "any", "aria-label": "time in the step" });
  const now = made("output");
  const play = made("button", "play", { type: "button" });
  /**
   * The span of time that the slider covers. The span surrounds the time of the contact or, if there is no
   * contact, the time of the smallest distance. It becomes shorter when the user zooms in.
   */
  const span = () => [Math.max(0, shown.time - 1 / view.zoom), Math.min(1, shown.time + 1 / view.zoom)];

  function draw() {
    const [from, to] = span();
    picture.draw({ ...view, isLabelled: true, normal: normal(view.time) });
    plots.draw(view.time, [from, to]);
    Object.assign(slider, { min: from, max: to, value: view.time });
    const difference = view.time - shown.time;
    now.textContent = view.zoom > 1 && difference !== 0 ? `t = t* ${difference > 0 ? "+" : "−"} ${rounded(Math.abs(difference), 2)}` : `t = ${short(view.time)}`;
    if (view.zoom > 1) now.textContent += `, ${short(view.zoom)} times larger`;
    play.textContent = view.frame ? "pause" : "play";
  }
  function change(next) {
    Object.assign(view, next);
    draw();
  }
  const zoomed = (factor) => {
    const zoom = Math.min(2 ** 40, Math.max(0.5, view.zoom * factor));
    Object.assign(view, { zoom });
    const [from, to] = span();
    change({ time: Math.min(to, Math.max(from, view.time)) });
  };
  play.addEventListener("click", () => {
    if (view.frame) {
      cancelAnimationFrame(view.frame);
      return change({ frame: 0 });
    }
    const [from, to] = span();
    const begin = performance.now() - (view.time < to ? (4000 * (view.time - from)) / (to - from) : 0);
    const move = (moment) => {
      const part = Math.min(1, (moment - begin) / 4000);
      change({ time: from + part * (to - from), frame: part < 1 && picture.svg.isConnected ? requestAnimationFrame(move) : 0 });
    };
    return change({ frame: requestAnimationFrame(move) });
  });
  slider.addEventListener("input", () => change({ time: Number(slider.value) }));
  const button = (title, label, act) => {
    const node = made("button", title, { type: "button", "aria-label": label, title: label });
    node.addEventListener("click", act);
    return node;
  };
  const keys = { "+": () => zoomed(2), "-": () => zoomed(0.5), 0: () => change(start) };
  makeTurnable(picture.svg, view, 150, draw, keys);
  picture.svg.setAttribute("tabindex", "0");
  picture.svg.addEventListener("wheel", (event) => {
    if (document.activeElement !== picture.svg) return; // the wheel then scrolls the page
    event.preventDefault();
    zoomed(2 ** (-event.deltaY / 300));
  });
  picture.svg.setAttribute("aria-label", `${picture.svg.getAttribute("aria-label")}; arrow keys turn the picture, +, - and the wheel zoom, 0 resets it`);
  draw();
  return [
    made("figure", [picture.svg, made("div", [slider, now], { class: "time" }), made("div", [
      ...(isStill ? [] : [play]),
      button("t*", "show t*, or when the primitives are closest", () => change({ time: shown.time })),
      ...(shown.toi === undefined ? [] : [button("toi", "show the time that the subject gave", () => change({ zoom: 1, time: shown.toi }))]),
      button("+", "larger", keys["+"]), button("−", "smaller", keys["-"]),
      button("contact", "a thousand times larger, at the contact", () => change({ zoom: 1000, time: shown.time })),
      button("reset", "reset the picture", keys[0]),
    ], { class: "mesh-controls" }), made("figcaption", [...pictureLegend(shown),
      ...(normal(shown.time) ? ["The grey plane between the primitives is that of the certificate."] : [])])]),
    made("div", plots.nodes, { class: "plots" }),
  ];
}
