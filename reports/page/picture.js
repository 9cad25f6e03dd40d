// Draws a query: both primitives at t = 0, at t* or when closest, at the time that a subject gave, and at t =
// 1, with the paths of their vertices.
"use strict";

/** The primitives of each kind as lists of vertices, and what they are. */
const shapes = {
  vt: { primitives: [[0], [1, 2, 3]], caption: "A vertex and a triangle" },
  ee: { primitives: [[0, 1], [2, 3]], caption: "Two edges" },
  vv: { primitives: [[0], [1]], caption: "Two vertices" },
  ve: { primitives: [[0], [1, 2]], caption: "A vertex and an edge" },
};

/**
 * A picture, with a legend if there is something to say: the separation, or the two times.
 * @param {string} kind as in kindTitles
 * @param {number[]} query six coordinates for each vertex; a separation other than 0 follows
 * @param {number} time in [0, 1]: t*, or when the primitives are closest
 * @param {number} [toi] the time that a subject gave for t*
 */
function drawPicture(kind, query, time, toi) {
  const x = query.slice(0, query.length - (query.length % 6));
  const half = x.length / 2; // the coordinates at t = 1 begin here
  const hasTwoTimes = toi !== undefined;
  const size = 220;
  const namespace = "http://www.w3.org/2000/svg";
  const { primitives, caption } = shapes[kind];

  const at = (t) => primitives.flat().map((i) => [0, 1, 2].map((k) => (1 - t) * x[3 * i + k] + t * x[half + 3 * i + k]));
  const moments = [[0, "start"], [1, "end"], ...(hasTwoTimes ? [[toi, "given"]] : []), [time, "moment"]].map(([t, name]) => ({ name, points: fitted(at(t)) }));

  /** The points, scaled and moved into [-1, 1]. */
  function fitted(points) {
    fitted.box ??= [0, 1, 2].map((k) => {
      const all = x.filter((_, i) => i % 3 === k).map((c) => c / 4); // so that no difference overflows
      return { middle: (Math.min(...all) + Math.max(...all)) / 2, half: (Math.max(...all) - Math.min(...all)) / 2 };
    });
    const half = Math.max(...fitted.box.map((side) => side.half)) || 1;
    return points.map((p) => p.map((c, k) => (c / 4 - fitted.box[k].middle) / half));
  }

  const turn = { yaw: -0.6, pitch: 0.5 };
  /** The place of a point on the screen, in parallel projection. */
  function seen([px, py, pz]) {
    const across = Math.cos(turn.yaw) * px + Math.sin(turn.yaw) * py;
    const depth = -Math.sin(turn.yaw) * px + Math.cos(turn.yaw) * py;
    const up = Math.cos(turn.pitch) * pz + Math.sin(turn.pitch) * depth;
    return [size / 2 + across * size * 0.29, size / 2 - up * size * 0.29].map((c) => c.toFixed(1));
  }

  const svg = document.createElementNS(namespace, "svg");
  svg.setAttribute("viewBox", `0 0 ${size} ${size}`);
  svg.setAttribute("class", hasTwoTimes ? "picture two-times" : "picture");
  svg.setAttribute("role", "img");
  svg.setAttribute("tabindex", "0");
  svg.setAttribute("aria-label", `${caption} at t = 0, at t = ` +
    `${time.toPrecision(4)}${hasTwoTimes ? `, at t = ${toi.toPrecision(4)}` : ""} and at t = 1, with the paths of their vertices; arrow keys turn the picture`);

  function add(tag, attributes) {
    const node = document.createElementNS(namespace, tag);
    for (const [name, value] of Object.entries(attributes)) node.setAttribute(name, value);
    svg.append(node);
  }

  function draw() {
    svg.replaceChildren();
    for (const i of primitives.flat()) {
      const [x1, y1] = seen(moments[0].points[i]);
      const [x2, y2] = seen(moments[1].points[i]);
      add("line", { x1, y1, x2, y2, class: "path" });
    }
    for (const { name, points } of moments)
      primitives.forEach((vertices, which) => {
        const shown = `${name} primitive${which}`;
        const corners = vertices.map((i) => seen(points[i]));
        if (corners.length > 1) add("polygon", { points: corners.map((p) => p.join(",")).join(" "), class: shown });
        for (const [cx, cy] of corners) add("circle", { cx, cy, r: corners.length === 1 ? 4 : 2, class: shown });
      });
  }

  makeTurnable(svg, turn, 80, draw);
  draw();
  return made("figure", [svg, made("figcaption", pictureLegend(separationOf(query), time, toi))]);
}

/** A line for the separation, and one for each of two times. */
function pictureLegend(separation, time, toi) {
  const line = (name, content) => made("div", [made("span", "", { class: `swatch ${name}` }), ` ${content}`]);
  const difference = toi - time;
  const against = difference === 0 ? "t*" : `t* ${difference > 0 ? "+" : "−"} ${short(Math.abs(difference))}`;
  return [
    ...(separation > 0 ? [made("div", `h = ${short(separation)}`)] : []),
    ...(toi === undefined ? [] : [line("moment", `t* = ${short(time)}`), line("given", `toi = ${against}`)]),
  ];
}
