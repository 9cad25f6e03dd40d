// Draws a step of a scene: its mesh, with collisions and wrong answers marked. Mouse and keys turn the
// picture.
"use strict";

/**
 * The colours of marked primitives, as a list. An entry has the bits of a mark, their meaning, and a colour.
 * A primitive gets the colour of the first entry that has a bit in common with the primitive's mark.
 */
function markColours(meanings, subject) {
  const bit = (meaning) => (meanings.includes(meaning) ? 1 << meanings.indexOf(meaning) : 0);
  return [
    { bits: bit(`missed by ${subject}`), name: `missed by ${subject}`, colour: "--bad" },
    { bits: bit(`falsely reported by ${subject}`), name: `falsely reported by ${subject}`, colour: "--false" },
    { bits: bit("tangled"), name: "tangled", colour: "--bad" },
    { bits: bit("collides"), name: "collides", colour: "--second" },
  ];
}

const numbersOf = (text) => (text === "" ? [] : text.split(" ").map(Number));

/** The primitives of a picture, as a list of {points: [indices], mark}. */
function primitivesOf(picture) {
  const cut = (text, size) => {
    const list = numbersOf(text);
    return Array.from({ length: list.length / (size + 1) }, (_, i) =>
      ({ points: list.slice(i * (size + 1), i * (size + 1) + size), mark: list[i * (size + 1) + size] }));
  };
  return [...cut(picture.triangles, 3), ...cut(picture.lines, 2), ...cut(picture.dots, 1)];
}

/**
 * Converts a picture to the form that drawMesh needs.
 * @param picture an entry of report.pictures; reports/campaign/scene_picture.hpp describes its format
 */
function readPicture(picture) {
  const primitives = primitivesOf(picture);
  const points = numbersOf(picture.points);
  const middle = [0, 1, 2].map((k) => {
    let [lo, hi] = [Infinity, -Infinity];
    for (let i = k; i < points.length; i += 3) {
      lo = Math.min(lo, points[i]);
      hi = Math.max(hi, points[i]);
    }
    return (lo + hi) / 2;
  });
  const subjects = [...new Set(picture.meanings.filter((m) => m.startsWith("missed by ")).map((m) => m.slice("missed by ".length)))];
  const wrongBits = (subject) => markColours(picture.meanings, subject).slice(0, 2).reduce((bits, each) => bits | each.bits, 0);
  const wrong = subjects.find((subject) => primitives.some((primitive) => primitive.mark & wrongBits(subject)));
  return { ...picture, name: picture.step.replace(/^scene:/, ""), whole: picture.primitives, primitives, points, middle, subjects, subject: wrong ?? subjects[0] };
}

/** The primitives of a picture that are tangled, or that belong to a pair that the subject missed. */
function missesOf({ meanings, primitives }, subject) {
  const bits = markColours(meanings, subject).filter(({ colour }) => colour === "--bad").reduce((all, each) => all | each.bits, 0);
  return primitives.filter(({ mark }) => mark & bits);
}

const meshSize = [640, 480];

/** A viewer of some entries of report.pictures. */
function drawMesh(entries) {
  const pictures = entries.map(readPicture);
  const view = { yaw: -0.6, pitch: 0.45, zoom: 1, time: 1, picture: pictures.find((each) => missesOf(each, each.subject).length > 0) ?? pictures[0], focus: undefined };
  view.subject = view.picture.subject;
  const canvas = made("canvas", [], { class: "mesh", tabindex: "0", role: "img" });
  const legend = made("div", [], { class: "mesh-legend" });
  const title = made("span");

  /**
   * The positions of all points at the view's time: x and y on the screen, and the depth, which grows away
   * from the eye.
   */
  function seen([width, height]) {
    const { points, middle } = view.picture;
    const count = points.length / 6;
    const at = new Float64Array(3 * count);
    const scale = (view.zoom * height) / 13000;
    const [sy, cy, sp, cp] = [Math.sin(view.yaw), Math.cos(view.yaw), Math.sin(view.pitch), Math.cos(view.pitch)];
    const place = (i, k) => (1 - view.time) * points[6 * i + k] + view.time * points[6 * i + 3 + k];
    const centre = [0, 1, 2].map((k) => (view.focus ? view.focus.points.reduce((sum, i) => sum + place(i, k), 0) / view.focus.points.length : middle[k]));
    for (let i = 0; i < count; ++i) {
      const [x, y, z] = [0, 1, 2].map((k) => place(i, k) - centre[k]);
      const depth = cy * y - sy * x;
      at[3 * i] = width / 2 + scale * (cy * x + sy * y);
      at[3 * i + 1] = height / 2 - scale * (cp * z + sp * depth);
      at[3 * i + 2] = scale * (cp * depth - sp * z);
    }
    return at;
  }

  function draw() {
    const { primitives, meanings, name, whole } = view.picture;
    const colours = markColours(meanings, view.subject).map((each) => ({ ...each, paint: color(each.colour) }));
    const dense = 2; // canvas pixels per CSS pixel, for sharp pictures on paper and on fine screens
    [canvas.width, canvas.height] = meshSize.map((side) => dense * side);
    const paint = canvas.getContext("2d");
    paint.scale(dense, dense);
    paint.lineJoin = "round";
    const at = seen(meshSize);
    const mean = (primitive, k) => primitive.points.reduce((sum, p) => sum + at[3 * p + k], 0) / primitive.points.length;
    const inOrder = primitives.map((primitive) => ({ primitive, depth: mean(primitive, 2), hit: colours.find((each) => primitive.mark & each.bits) }))
      .sort((a, b) => b.depth - a.depth);
    for (const { primitive, hit } of inOrder) {
      const [first, ...others] = primitive.points;
      paint.beginPath();
      if (others.length === 0) {
        paint.arc(at[3 * first], at[3 * first + 1], hit ? 2.2 : 1.2, 0, 7);
        paint.fillStyle = hit ? hit.paint : color("--soft");
        paint.fill();
        continue;
      }
      paint.moveTo(at[3 * first], at[3 * first + 1]);
      for (const p of others) paint.lineTo(at[3 * p], at[3 * p + 1]);
      paint.closePath();
      paint.strokeStyle = hit ? hit.paint : color("--soft");
      paint.lineWidth = hit ? 1 : 0.3;
      if (others.length === 2) {
        paint.fillStyle = hit ? hit.paint : color("--face");
        paint.fill();
      }
      paint.stroke();
    }
    // A ring marks each small primitive that was missed or is tangled, even if other primitives hide it.
    for (const primitive of missesOf(view.picture, view.subject)) {
      const isFocus = primitive === view.focus;
      const [x, y] = [mean(primitive, 0), mean(primitive, 1)];
      if (!isFocus && primitive.points.some((p) => Math.hypot(at[3 * p] - x, at[3 * p + 1] - y) > 8)) continue;
      paint.strokeStyle = color(isFocus ? "--ink" : "--bad");
      paint.lineWidth = isFocus ? 2.5 : 1.2;
      paint.beginPath();
      paint.arc(x, y, isFocus ? 16 : 8, 0, 7);
      paint.stroke();
    }
    const marked = primitives.filter((primitive) => primitive.mark !== 0).length;
    canvas.setAttribute("aria-label", `The mesh of ${name}: ${integer(marked)} of ${integer(primitives.length)} primitives are marked; ` +
      "arrow keys turn the picture, + and - change its size");
    title.replaceChildren(made("strong", name), primitives.length < whole ? `: ${integer(primitives.length)} of ${integer(whole)} primitives are shown` : "");
    legend.replaceChildren(...colours.flatMap(({ bits, name: meaning, paint: fill }) => {
      const number = primitives.filter((primitive) => primitive.mark & bits).length;
      const swatch = made("span", [], { class: "swatch" });
      swatch.style.background = fill;
      return number === 0 ? [] : [made("span", [swatch, ` ${meaning} (${counted(number, "primitive", "primitives")}) `])];
    }), ...(missesOf(view.picture, view.subject).length > 0 ? [`Rings: small primitives that are ${view.picture.subjects.length > 0 ? "missed" : "tangled"}; the black one was chosen last.`] : []));
  }

  function change(next) {
    Object.assign(view, next);
    draw();
  }
  const keys = { "+": () => change({ zoom: view.zoom * 1.3 }), "-": () => change({ zoom: view.zoom / 1.3 }) };
  makeTurnable(canvas, view, 120, draw, keys);
  const button = (label, key, act) => {
    const node = made("button", key, { type: "button", "aria-label": label });
    node.addEventListener("click", act);
    return node;
  };
  const time = made("input", [], { type: "range", min: "0", max: "1", step: "0.01", value: "1" });
  time.addEventListener("input", () => change({ time: Number(time.value) }));
  const step = made("select", pictures.map(({ name }, i) => made("option", name, { value: i })));
  const answers = made("select");
  const which = made("label", [" answers of ", answers]);
  answers.addEventListener("change", () => change({ subject: answers.value, focus: undefined }));
  function choose(picture) {
    step.value = pictures.indexOf(picture);
    answers.replaceChildren(...picture.subjects.map((name) => made("option", name, { value: name })));
    const subject = picture.subjects.includes(view.subject) ? view.subject : picture.subject;
    answers.value = subject;
    which.toggleAttribute("hidden", picture.subjects.length < 2);
    change({ picture, subject, focus: undefined });
  }
  step.addEventListener("change", () => choose(pictures[step.value]));
  /**
   * Shows the next miss of this picture. After the last miss, shows the first miss of the next picture that
   * has misses.
   */
  function showNextMiss() {
    const misses = missesOf(view.picture, view.subject);
    const after = misses.indexOf(view.focus) + 1;
    if (after < misses.length) {
      const { points } = view.picture;
      const [first, ...others] = misses[after].points;
      const size = Math.max(...others.flatMap((i) => [0, 1, 2].map((k) => Math.abs(points[6 * i + k] - points[6 * first + k]))), 1);
      return change({ focus: misses[after], zoom: Math.min(30, Math.max(1.3, 2700 / size)) }); // about 100 pixels
    }
    const place = pictures.indexOf(view.picture) + 1;
    const picture = [...pictures.slice(place), ...pictures].find((each) => missesOf(each, each.subjects.includes(view.subject) ? view.subject : each.subject).length > 0);
    if (!picture) return undefined;
    choose(picture);
    return showNextMiss();
  }
  choose(view.picture);
  const isMissed = pictures.some((each) => [undefined, ...each.subjects].some((subject) => missesOf(each, subject).length > 0));
  const next = pictures.some(({ subjects }) => subjects.length > 0) ? "next miss" : "next tangle";
  return made("figure", [
    made("figcaption", title), canvas, legend,
    made("div", [...(pictures.length > 1 ? [made("label", ["step ", step]), " "] : []), made("label", ["t ", time]), which, " ",
      ...(isMissed ? [button(next, next, showNextMiss)] : []),
      button("larger", "+", keys["+"]), button("smaller", "−", keys["-"]),
      button("the whole picture", "whole", () => change({ zoom: 1, focus: undefined }))], { class: "mesh-controls" }),
  ], { class: "scene-picture" });
}
