// Tests what is seen before scrolling.
import assert from "node:assert/strict";
import { jsonOf, makeReport, open, pageOf, run } from "./session.mjs";

const failing = "basic,basic-plain,defect:vv,defect:proximity,defect:D2*0,defect:S*0,defect:psi*0,defect:rho*0,defect:lambda2*0,defect:mu*0";

/** Without scrolling, on a common screen: is it safe, what does it cost, what is new, how is a failure reproduced. */
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
    assert.match(row, new RegExp(`${Number(times.median_ns.toPrecision(3)).toLocaleString("en-US")}, 99 % `));
  }
  const rates = verdicts.map(({ counts }) => counts.false_negative_rate);
  assert.match(await rows.first().textContent(), new RegExp(`^(FAIL|ok)${verdicts[rates.indexOf(Math.max(...rates))].subject.replaceAll("*", "\\*")}`));
  await page.close();
  return failed.length;
}

export async function answersBeforeScrolling(browser) {
  for (const [name, subjects] of [["one", "wang"], ["three", "basic,exact,wang"], ["eleven", `${failing},wang`]]) {
    run("fuzz", "--cases", "3000", "--subject", subjects, "--db", `${name}-before.db`);
    makeReport(name, ["--cases", "3000", "--seed", "2", "--subject", subjects], ["--baseline", `${name}-before.db`]);
  }
  assert.equal(await answersEverything(browser, "one"), 0);
  assert.equal(await answersEverything(browser, "three"), 1);
  assert.ok((await answersEverything(browser, "eleven")) >= 6);
}
