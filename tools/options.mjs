// Reads the options of scripts for Node.js as tools/options.sh does: --help and -h print the comment at the
// top of the script, and an unknown option ends the script with exit code 2 before it does anything.
import { readFileSync } from "node:fs";
import path from "node:path";
import { parseArgs } from "node:util";

/** The options and other arguments of the script. Options are declared as for parseArgs of node:util. */
export function readOptions(declared = {}, allowPositionals = false) {
  const script = process.argv[1];
  try {
    const { values, positionals } = parseArgs({ options: { ...declared, help: { type: "boolean", short: "h" } }, allowPositionals });
    if (!values.help) return { options: values, positionals };
  } catch (error) {
    console.error(`${path.basename(script)}: ${error.message}`);
    process.exit(2);
  }
  const [comment] = /^(\/\/.*\n)*/.exec(readFileSync(script, "utf8"));
  console.log(comment.replaceAll(/^\/\/ ?/gm, "").trimEnd());
  process.exit(0);
}
