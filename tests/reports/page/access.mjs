// Tests that everybody can use the page, and that it stays quick with many findings.
import assert from "node:assert/strict";
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { pathToFileURL } from "node:url";
import { count, folder, open, pageOf } from "./session.mjs";

const axe = readFileSync(new URL("../../../reports/page/node_modules/axe-core/axe.min.js", import.meta.url), "utf8");

export async function axeViolations(page) {
  await page.evaluate(axe);
  const { violations } = await page.evaluate(() => axe.run({ resultTypes: ["violations"], selectors: false }));
  return violations.map(({ id, nodes }) => `${id}: ${nodes.length} times, such as ${nodes[0].html.slice(0, 200)} (${nodes[0].failureSummary})`);
}

export async function hasNoBarriers(browser) {
  const [light, dark, phone] = [{}, { colorScheme: "dark" }, { viewport: { width: 390, height: 800 } }];
  for (const [name, ...all] of [["found", light, dark, phone], ["timed", dark], ["many", phone], ["clean", light], ["later", dark], ["decided", light], ["options", light, dark]])
    for (const options of all) {
      const page = await open(browser, pageOf(name), options);
      assert.deepEqual(await axeViolations(page), [], `${name} ${JSON.stringify(options)}`);
    }
}

/** Copies the page of a report, repeats its findings until there are `many`, and returns its address. */
function withFindings(name, many) {
  const page = readFileSync(join(folder, name, "index.html"), "utf8");
  const begin = page.indexOf(">", page.indexOf('id="report"')) + 1;
  const end = page.indexOf("</script>", begin);
  const report = JSON.parse(page.slice(begin, end));
  const { findings } = report;
  report.findings = Array.from({ length: many }, (_, i) => ({ ...findings[i % findings.length], provenance: `number-${i}` }));
  const file = join(folder, `${many}.html`);
  writeFileSync(file, page.slice(0, begin) + JSON.stringify(report).replaceAll("<", "\\u003c") + page.slice(end));
  return pathToFileURL(file).href;
}

/**
 * The page draws at most 24 findings at first, and the search finds any other. Prints the times of drawing
 * and of searching.
 */
export async function staysQuickWithManyFindings(browser) {
  for (const many of [10, 10000]) {
    const page = await open(browser, withFindings("found", many));
    const paint = await page.evaluate(() => performance.getEntriesByName("first-contentful-paint")[0].startTime);
    assert.equal(await count(page, "#findings .card"), Math.min(many, 24));
    const search = await page.evaluate((words) => {
      const input = document.querySelector("#findings-filter [name=words]");
      const begin = performance.now();
      input.value = words;
      input.dispatchEvent(new Event("input", { bubbles: true }));
      document.body.getBoundingClientRect(); // forces the layout, so that the measured time includes it
      return performance.now() - begin;
    }, `number-${many - 1}`);
    assert.equal(await page.textContent("#findings-count"), `1 of 1 shown, out of ${many.toLocaleString("en-US")}`);
    console.log(`${many} findings: first paint after ${Math.round(paint)} ms, filtered in ${search.toFixed(1)} ms`);
  }
}
