// Tests the precision ladder (one CCD in several scalar types) and the audit of rounding constants.
import assert from "node:assert/strict";
import { count, jsonOf, open, pageOf, plugin, run } from "./session.mjs";

/** Each algorithm has a colour. Labels name the scalars, and do not overlap. */
async function showsErrorTimeOfTheLadder(page, { subjects, ladder, front_by_rate }) {
  assert.equal(await page.isVisible("#error-time-of-ladder"), true);
  assert.equal(await page.isVisible("#error-time-of-each"), false);
  const fills = (selector) => page.locator(selector).evaluateAll((all) => all.map((each) => each.getAttribute("fill")));
  for (const [panel, front] of [[0, ladder.front_by_distance], [1, front_by_rate]]) {
    const inPanel = `#error-time .concat_${panel}_group`;
    const points = await fills(`${inPanel} .mark-symbol.role-mark path`);
    assert.equal(points.length, Object.keys(subjects).length);
    assert.equal(new Set(points).size, 2);
    // The chart has a line for the front, and two lines for each of two algorithms: one for the machine's
    // scalars, and one for emulated scalars.
    assert.equal(await count(page, `${inPanel} .mark-line path`), 1 + 4);
    const labels = await page.locator(`${inPanel} .mark-text.role-mark text`).evaluateAll((all) => all
      .filter((each) => each.getAttribute("stroke") === null || each.getAttribute("stroke") === "none")
      .map((each) => ({ text: each.textContent, bold: each.getAttribute("font-weight") === "bold", box: each.getBoundingClientRect().toJSON() })));
    assert.deepEqual(labels.filter(({ bold }) => bold).map(({ text }) => text).sort(), front.map((name) => subjects[name].scalar).sort());
    assert.ok(labels.length >= 3 && labels.length <= points.length);
    // The box of a label is 2 pixels taller than its letters.
    const apart = (a, b) => a.right <= b.left || b.right <= a.left || a.bottom <= b.top + 2 || b.bottom <= a.top + 2;
    labels.forEach(({ box }, i) => labels.slice(0, i).forEach((other) => assert.ok(apart(box, other.box))));
  }
  const pale = () => count(page, "#error-time .mark-symbol.role-mark path[opacity='0.1']");
  assert.equal(await pale(), 0);
  await page.locator("#error-time .role-legend-label text", { hasText: /^wang-tight$/ }).click();
  assert.equal(await pale(), Object.keys(subjects).length); // pale: half of the points, in each of two panels
  await page.locator("#error-time .role-legend-label text", { hasText: /^wang-tight$/ }).click();
}

export async function showsTheLadderAndTheAudit(browser) {
  run("ladder", "--scalar", "float,p40,p64", "--cases", "320", "--db", "ladder.db");
  run("audit", "--json", "audit.json");
  run("paper", "constants", "planes", "gpu", "--json", "paper.json");
  run("distance", "--subject", `${plugin("distances")}:defect=5`, "--cases", "20000", "--json", "distances.json");
  run("report", "ladder.db", "-o", "ladder", "--audit", "audit.json", "--paper", "paper.json", "--distances", "distances.json");
  const page = await open(browser, pageOf("ladder"));
  assert.equal(await count(page, "#ladder tbody tr"), 6);
  assert.equal(await count(page, "#ladder-chart .mark-line path"), 2); // the bounds of both algorithms
  const report = jsonOf("ladder");
  await showsErrorTimeOfTheLadder(page, report.error_against_time);
  assert.match(await page.textContent("#ladder-fits"), /^wang: the farthest distance goes as ε to the power of 0\.\d+ ± [\d.]+ \(95 % confidence\), at [\d.]+–[\d.]+ of the claimed distance for 3 subjects with 3 precisions\. wang-tight: the farthest are at 0\.9\d+–0\.9\d+ of the claimed distance for 3 subjects with 3 precisions\. The paper predicts a power of ¼\.$/);
  const origins = new Set(report.ladder.fits.map((fit) => fit.origin).filter((origin) => origin !== ""));
  assert.ok(origins.size > 1);
  assert.deepEqual(new Set(await page.locator("#ladder-origins tbody td:first-child").allTextContents()), origins);
  assert.equal(await count(page, "#paper tbody tr"), 3);
  assert.match(await page.locator("#paper").textContent(), /nearly one third pass plane culling/);
  const { counts, findings } = jsonOf("ladder").distances;
  assert.equal(await count(page, "#feature-distances tbody tr"), counts.length);
  assert.equal(await count(page, "#feature-findings tbody tr"), findings.length);
  assert.match(await page.locator("#feature-ranges").textContent(), /edge/);
  assert.match(await page.locator("#feature-findings").textContent(), /over-reported: .*; the distance is/);
  assert.ok((await count(page, "#audit tbody tr")) > 50);
  assert.ok((await count(page, "#audit td.bad")) >= 2);
  assert.match(await page.locator("#audit").textContent(), /not proven by Theorem 4\.1: relative positions/);
  assert.ok((await count(page, "#tolerances tbody tr")) >= 10);
}
