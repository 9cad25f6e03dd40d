// The list of defects, defects/*.txt: reads it, and applies a defect to the text of a file.
//
//   NAME in FILE (2 of 3): the error that the edit makes
//   - the text to find, once in the file, or at the second of three places; any blanks and line ends match
//   + the text that replaces it
//   = for a defect that nothing finds: why it changes no answer, or what would find it
import { readdirSync, readFileSync } from 'node:fs';
import path from 'node:path';
import { fileURLToPath } from 'node:url';

export const here = path.dirname(fileURLToPath(import.meta.url));

const heading = /^(\S+) in (\S+?\.[ch]pp)(?: \((\d+) of (\d+)\))?: (.+)$/;

function parseDefect(lines, group) {
  const match = heading.exec(lines[0]);
  if (!match) throw new Error(`found '${lines[0]}', expected 'NAME in FILE: ABOUT'`);
  const behind = (sign) => lines.slice(1).filter((line) => line[0] === sign).map((line) => line.slice(1).trim());
  const strange = lines.slice(1).find((line) => !'-+='.includes(line[0]));
  if (strange) throw new Error(`${match[1]}: found '${strange}', expected a line that starts with -, + or =`);
  return {
    name: match[1],
    file: `oracle/${match[2]}`,
    occurrence: Number(match[3] ?? 1),
    occurrences: Number(match[4] ?? 1),
    about: match[5],
    group,
    before: behind('-').join(' '),
    after: behind('+').join('\n'),
    reason: behind('=').join(' '),
  };
}

/** All defects, in the order of the list. */
export function readDefects(folder = path.join(here, 'defects')) {
  const defects = [];
  let group = '';
  const text = readdirSync(folder).sort().map((name) => readFileSync(path.join(folder, name), 'utf8')).join('\n\n');
  for (const block of text.split(/\n\s*\n/)) {
    const lines = block.split('\n').filter((line) => line.trim() !== '' && !line.startsWith('#'));
    const title = /^== (.+) ==$/.exec(lines[0] ?? '');
    if (title) group = title[1];
    else if (lines.length > 0) defects.push(parseDefect(lines, group));
  }
  const names = new Set();
  for (const { name } of defects) {
    if (names.has(name)) throw new Error(`${name} stands in the list twice`);
    names.add(name);
  }
  return defects;
}

/** The text of a file with the defect; blanks and line ends between words of `before` match any others. */
export function applied(defect, text) {
  const words = defect.before.split(/\s+/).map((word) => word.replace(/[.*+?^${}()|[\]\\]/g, '\\$&'));
  const places = [...text.matchAll(new RegExp(words.join('\\s+'), 'g'))];
  if (places.length !== defect.occurrences)
    throw new Error(
      `${defect.name}: '${defect.before}' occurs ${places.length} times in ${defect.file}, expected ${defect.occurrences}`);
  const { index, 0: found } = places[defect.occurrence - 1];
  return text.slice(0, index) + defect.after + text.slice(index + found.length);
}
