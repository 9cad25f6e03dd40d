// Tests what the page shows before scrolling.
import assert from "node:assert/strict";
import { count, jsonOf, makeReport, open, pageOf, run } from "./session.mjs";

const failing = "basic,basic-plain,defect:vv,defect:proximity,defect:D2*0,defect:S*0,defect:psi*0,defect:rho*0,defect:lambda2*0,defect:mu*0";

/**
 * A screen of common size shows, without scrolling, whether a CCD is safe, what it costs, what is new, and
 * how to replay a failure.
 */
async function answersEverything(browser, name) {
  const page = await open(browser, pageOf(name), { viewport: { width: 1440, height: 900 } });
  const { verdicts } = jsonOf(name);
  const table = await page.locator("#scorecard").boundingBox();
  assert.ok(table.y + table.height <= 900, `${name}: the table ends at ${table.y + table.height}`);
  const box = await page.locator("#verdicts .scroll").boundingBox();
  assert.ok(table.x + table.width <= box.x + box.width + 1, `${name}: the table is wider than its box`);
  const headings = await page.locator("#scorecard th").allTextContents();
  for (const title of ["missed collisions", "false positives", "ns a query, median", "since the baseline"]) assert.ok(headings.includes(title), title);
  const rows = page.locator("#scorecard .verdict");
  assert.equal(await rows.count(), verdicts.length);
  const failed = verdicts.filter(({ clean }) => !clean);
  assert.equal(await rows.locator("button.copy").count(), failed.length);
  for (const { subject, counts, times } of verdicts) {
    const row = await rows.filter({ has: page.locator("td:nth-child(2)").getByText(subject, { exact: true }) }).textContent();
    assert.ok(row.includes(`${counts.false_negatives.toLocaleString("en-US")} of ${counts.collisions.toLocaleString("en-US")}`), row);
    assert.match(row, new RegExp(`${Number(Number.isInteger(times.median_ns) ? times.median_ns : times.median_ns.toPrecision(3)).toLocaleString("en-US")}, 99 % `));
  }
  const rates = verdicts.map(({ classes }) => classes.ordinary.false_negative_rate);
  if (Math.max(...rates) > 0) assert.match(await rows.first().textContent(), new RegExp(`^FAIL${verdicts[rates.indexOf(Math.max(...rates))].subject.replaceAll("*", "\\*")}`));
  return failed.length;
}

/**
 * For a night that also has a scene and a precision ladder (one CCD in several scalar types), the first table
 * has one row for all subjects of the ladder that did not fail, and still fits on the screen.
 */
async function answersBesideAScene(browser) {
  run("ladder", "--scalar", "float,p40,p48,p56,p64", "--cases", "160", "--db", "rungs.db");
  run("scene", "spikes@100", "--subject", "wang,basic", "--db", "beside.db");
  run("report", "eleven.db", "beside.db", "rungs.db", "--baseline", "eleven-before.db", "-o", "night");
  const page = await open(browser, pageOf("night"), { viewport: { width: 1440, height: 900 } });
  const { verdicts, baseline, subjects } = jsonOf("night");
  const own = verdicts.filter(({ subject, algorithm }) => subject === algorithm);
  assert.ok(verdicts.length >= own.length + 10);
  const table = await page.locator("#scorecard").boundingBox();
  assert.ok(table.y + table.height <= 900, `the table ends at ${table.y + table.height}`);
  const shown = page.locator("#scorecard .verdict:visible");
  assert.equal(await shown.count(), verdicts.filter((each) => !each.clean || own.includes(each)).length + 1);
  assert.match(await shown.last().textContent(), /^ok \d+ others did not fail$/);
  await shown.last().locator("button").click();
  assert.equal(await shown.count(), verdicts.length + 1);
  assert.ok(baseline.absent_subjects.length >= 10);
  assert.equal(await page.locator("#news li", { hasText: /^Not in the baseline: / }).count(), 1);
  const kinds = own.flatMap(({ subject }) => Object.keys(subjects[subject]));
  assert.equal(await count(page, "#before-and-now tbody tr"), kinds.length);
  const slow = new Set(await page.locator("#slowest tbody td:first-child").allTextContents());
  assert.deepEqual(slow, new Set(own.map(({ subject }) => subject)));
}

export async function answersBeforeScrolling(browser) {
  for (const [name, subjects] of [["one", "wang"], ["three", "basic,exact,wang"], ["eleven", `${failing},wang`]]) {
    const fuzz = ["--cases", "3000", "--no-shrink", "--subject", subjects];
    run("fuzz", ...fuzz, "--db", `${name}-before.db`);
    makeReport(name, [...fuzz, "--seed", "2"], ["--baseline", `${name}-before.db`]);
  }
  assert.equal(await answersEverything(browser, "one"), 0);
  assert.equal(await answersEverything(browser, "three"), 1);
  assert.ok((await answersEverything(browser, "eleven")) >= 6);
  await answersBesideAScene(browser);
}
