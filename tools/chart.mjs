// Writes a chart of a report as an SVG file, or any element of the report's page as a PNG file. Opens the
// page in Chromium, as a user does.
// Usage: node tools/chart.mjs REPORT CHART OUT.svg|OUT.png
//   REPORT  the folder of a report
//   CHART   the id of a chart on the report's page, such as error-time, misses or distances; for a PNG file,
//           the id of any element
//   OUT     the file to write; a name that ends in -dark.svg gets the colours of a dark page
import { existsSync, writeFileSync } from "node:fs";
import { join, resolve } from "node:path";
import { pathToFileURL } from "node:url";
import { readOptions } from "./options.mjs";

const refuse = (why) => {
  console.error(`tools/chart.mjs: ${why}`);
  process.exit(2);
};
const { positionals } = readOptions({}, true);
if (positionals.length !== 3) refuse(`found ${positionals.length} arguments, expected REPORT CHART OUT.svg or OUT.png`);
const [report, chart, out] = positionals;
const file = join(resolve(report), "index.html");
if (!existsSync(file)) refuse(`found no '${file}', expected the folder of a report`);

const { chromium } = await import("../reports/page/node_modules/playwright-core/index.mjs");
const browser = await chromium.launch({ executablePath: "/usr/bin/chromium", args: ["--no-sandbox", "--disable-gpu"] });
try {
  const isDark = out.endsWith("-dark.svg");
  const page = await browser.newPage({ offline: true, viewport: { width: 1100, height: 800 }, colorScheme: isDark ? "dark" : "light" });
  await page.goto(pathToFileURL(file).href);
  await page.waitForSelector("body[data-drawn], body[data-error]");
  const part = page.locator(`[id="${chart.replace(/["\\]/g, "\\$&")}"]`);
  if ((await part.count()) === 0) refuse(`${file}: found no chart '${chart}'`);
  if (out.endsWith(".png")) {
    await page.emulateMedia({ media: "print" }); // hides the buttons
    await part.screenshot({ path: out });
    process.exit(0);
  }
  const svg = await page.evaluate(([id, fill]) => {
    const drawn = document.querySelector(`#${CSS.escape(id)} svg.marks`);
    if (!drawn) return undefined;
    const paper = document.createElementNS("http://www.w3.org/2000/svg", "rect");
    for (const [name, value] of Object.entries({ width: "100%", height: "100%", fill })) paper.setAttribute(name, value);
    drawn.prepend(paper); // a background, so that the chart can be read on a page of any colour
    return new XMLSerializer().serializeToString(drawn);
  }, [chart, isDark ? "#0d1117" : "white"]);
  if (svg === undefined) refuse(`${file}: found no chart '${chart}'`);
  writeFileSync(out, `${svg}\n`);
} finally {
  await browser.close();
}
