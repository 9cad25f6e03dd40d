// Draws a query: the two primitives at one time, and the paths of their vertices. The two primitives are also
// drawn in pale colours at both ends of the step, and at the time that a subject gave.
"use strict";

/** For each kind, the two primitives as lists of vertices, and a caption that names the primitives. */
const shapes = {
  vt: { primitives: [[0], [1, 2, 3]], caption: "A vertex and a triangle" },
  ee: { primitives: [[0, 1], [2, 3]], caption: "Two edges" },
  vv: { primitives: [[0], [1]], caption: "Two vertices" },
  ve: { primitives: [[0], [1, 2]], caption: "A vertex and an edge" },
};

function svgMade(tag, attributes, content = []) {
  const node = document.createElementNS("http://www.w3.org/2000/svg", tag);
  for (const [name, value] of Object.entries(attributes)) node.setAttribute(name, value);
  node.append(...[content].flat());
  return node;
}

const minus = (a, b) => a.map((c, k) => c - b[k]);
const along = (a, b, s) => a.map((c, k) => (1 - s) * c + s * b[k]);
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const cross = (a, b) => [0, 1, 2].map((k) => a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3]);

/**
 * A query whose coordinates are moved and scaled into [-1, 1]. The function `at` returns the scaled places of
 * the vertices at the time t of the query's step. If another step of the same vertices is passed as second
 * argument, `at` returns their places at the time t of that step. `unit` is the length that is scaled to 1.
 */
function scaledQuery(query) {
  const x = query.slice(0, query.length - (query.length % 6));
  const sides = [0, 1, 2].map((k) => {
    const all = x.filter((_, i) => i % 3 === k).map((c) => c / 4); // divided by 4, so that no difference overflows
    return { middle: (Math.min(...all) + Math.max(...all)) / 2, half: (Math.max(...all) - Math.min(...all)) / 2 };
  });
  const half = Math.max(...sides.map((side) => side.half)) || 1;
  const vertices = x.length / 6;
  const place = (list, i) => sides.map(({ middle }, k) => (list[3 * i + k] / 4 - middle) / half);
  return { unit: 4 * half,
    at: (t, step = x) => Array.from({ length: vertices }, (_, i) => along(place(step, i), place(step, vertices + i), t)) };
}

/**
 * The point of the first primitive that is closest to the second primitive, given the places of the
 * vertices.
 */
function closestPoint(kind, [x0, x1, x2, x3]) {
  if (kind !== "ee") return x0;
  const inside = (s) => Math.min(1, Math.max(0, s || 0));
  const [d, e, r] = [minus(x1, x0), minus(x3, x2), minus(x0, x2)];
  const s = inside((dot(d, e) * dot(e, r) - dot(d, r) * dot(e, e)) / (dot(d, d) * dot(e, e) - dot(d, e) ** 2));
  const u = inside((dot(d, e) * s + dot(e, r)) / dot(e, e));
  return along(x0, x1, inside((dot(d, e) * u - dot(d, r)) / dot(d, d)));
}

/**
 * The part of a polygon inside a square. Polygons are clipped because browsers draw points far outside of the
 * picture inexactly.
 */
function clipped(points, low, high) {
  for (const [k, border, sign] of [[0, low, 1], [0, high, -1], [1, low, 1], [1, high, -1]]) {
    const isInside = (p) => sign * (p[k] - border) >= 0;
    points = points.flatMap((p, i) => {
      const q = points[(i + 1) % points.length];
      return [...(isInside(p) ? [p] : []), ...(isInside(p) === isInside(q) ? [] : [along([...p, 0], [...q, 0], (border - p[k]) / (q[k] - p[k])).slice(0, 2)])];
    });
  }
  return points;
}

/**
 * A picture that can be drawn again.
 * @param shown {kind, query, time: t* or the time at which the primitives are closest, toi: the time that a
 * subject gave for t*, step: the rounded step from 0 to toi, if this step has contact}; toi and step may be
 * missing
 * @param size [width, height]
 * @returns {svg, draw(view)}; a view has {yaw, pitch, zoom, time, isLabelled, normal: the normal of a plane
 * between the primitives}
 */
function makePicture({ kind, query, time, toi, step }, [width, height]) {
  const { primitives, caption } = shapes[kind];
  const { at } = scaledQuery(query);
  const contact = closestPoint(kind, at(time));
  const fit = (0.46 * height) / (Math.max(...[at(0), at(1)].flat().map((p) => Math.hypot(...p))) || 1); // fits at every turn
  const others = [[at(0), "start"], [at(1), "end"], ...(toi === undefined ? [] : [[at(toi), "given"]]), ...(step ? [[at(1, step), "committed"]] : [])];
  const svg = svgMade("svg", { viewBox: `0 0 ${width} ${height}`, class: toi === undefined ? "picture" : "picture two-times", role: "img",
    "aria-label": `${caption} at t = 0, at t = ${time.toPrecision(4)}${toi === undefined ? "" : `, at t = ${toi.toPrecision(4)}`} and at t = 1, ` +
      "with the paths of their vertices" });

  function draw({ yaw, pitch, zoom, time: now, isLabelled, normal }) {
    const far = 3 * width;
    /**
     * The place of a point on the screen, by parallel projection. When the user zooms in, the contact moves
     * to the middle of the picture.
     */
    const seen = (point) => {
      const [px, py, pz] = point.map((c, k) => zoom * (c - contact[k]) + (zoom > 1 ? 1 / zoom : zoom) * contact[k]);
      const depth = -Math.sin(yaw) * px + Math.cos(yaw) * py;
      return [width / 2 + fit * (Math.cos(yaw) * px + Math.sin(yaw) * py), height / 2 - fit * (Math.cos(pitch) * pz + Math.sin(pitch) * depth)];
    };
    const polygon = (points, name) => {
      const corners = clipped(points.map(seen), -far, far);
      return corners.length < 2 ? [] : [svgMade("polygon", { points: corners.map((p) => p.map((c) => c.toFixed(1)).join(",")).join(" "), class: name })];
    };
    const circle = ([cx, cy], r, name) => (Math.max(Math.abs(cx), Math.abs(cy)) > far ? [] : [svgMade("circle", { cx: cx.toFixed(1), cy: cy.toFixed(1), r, class: name })]);
    /** The names of vertices. Vertices at one place in the picture have one label, "x0, x2". */
    const labels = (all) => {
      const groups = [];
      for (const [i, [x, y]] of all.entries()) {
        const group = groups.find((each) => Math.hypot(each.x - x, each.y - y) < 4);
        if (group) group.names.push(`x${i}`);
        else groups.push({ x, y, names: [`x${i}`] });
      }
      return groups.map(({ x, y, names }) => svgMade("text", { x: x + 7, y: y - 7 }, names.join(", ")));
    };
    const places = at(now);
    const moments = [...others, [places, "moment"]];
    const plane = normal ? polygon(planeBetween(primitives.map((vertices) => vertices.map((i) => places[i])), normal), "plane") : [];
    svg.replaceChildren(
      ...primitives.flat().flatMap((i) => polygon([others[0][0][i], others[1][0][i]], "path")), ...plane,
      ...moments.flatMap(([points, name]) => primitives.flatMap((vertices, which) => [
        ...(vertices.length > 1 ? polygon(vertices.map((i) => points[i]), `${name} primitive${which}`) : []),
        ...vertices.flatMap((i) => circle(seen(points[i]), vertices.length === 1 ? 4 : 2, `${name} primitive${which}`)),
      ])),
      ...(isLabelled ? [...circle(seen(contact), 9, "contact"), ...labels(places.map(seen))] : []));
  }
  return { svg, draw };
}

/** A square in a plane with this normal. The plane is halfway between the vertices of the two primitives. */
function planeBetween(points, normal) {
  const least = Math.min(...points[0].map((p) => dot(normal, p)));
  const most = Math.max(...points[1].map((p) => dot(normal, p)));
  const all = points.flat();
  const middle = [0, 1, 2].map((k) => all.reduce((sum, p) => sum + p[k], 0) / all.length);
  const unit = (v) => v.map((c) => c / Math.hypot(...v));
  const side = unit(cross(normal, Math.abs(normal[0]) < 0.6 ? [1, 0, 0] : [0, 1, 0]));
  const up = cross(normal, side);
  const height = (least + most) / 2 - dot(normal, middle);
  return [[-1, -1], [1, -1], [1, 1], [-1, 1]].map(([a, b]) => middle.map((c, k) => c + height * normal[k] + 0.7 * (a * side[k] + b * up[k])));
}

/**
 * The lines of the legend: the separation, the exact earliest time t*, the subject's time, and the committed
 * step. A line is left out if the query does not have it.
 */
function pictureLegend({ query, time, toi, step }) {
  const line = (name, content) => made("div", [made("span", "", { class: `swatch ${name}` }), ` ${content}`]);
  const difference = toi - time;
  const against = difference === 0 ? "t*" : `t* ${difference > 0 ? "+" : "−"} ${short(Math.abs(difference))}`;
  return [
    ...(separationOf(query) > 0 ? [made("div", `h = ${short(separationOf(query))}`)] : []),
    ...(toi === undefined ? [] : [line("moment", `t* = ${short(time)}`), line("given", `toi = ${against}`)]),
    ...(step ? [line("committed", "end of the committed step")] : []),
  ];
}
