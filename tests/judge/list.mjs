// The lists of defects: reads them, and applies a defect to the text of a file.
//
//   NAME in FILE (2 of 3): the error that the edit makes
//   - the text to find, once in the file, or at the second of three places; any blanks and line ends match
//   + the text that replaces it
//   and in FILE
//   - the text to find in one more place
//   + the text that replaces it
//   = for a defect that no step finds: why it changes no answer, or what would find it
import { readdirSync, readFileSync } from 'node:fs';
import path from 'node:path';
import { fileURLToPath } from 'node:url';

export const here = path.dirname(fileURLToPath(import.meta.url));

const heading = /^(\S+) in (\S+?\.[ch]pp)(?: \((\d+) of (\d+)\))?(?:: (.+))?$/;

function parseDefect(lines, group, sources) {
  const [, name, , , , about] = heading.exec(lines[0]) ?? [];
  if (!about) throw new Error(`found '${lines[0]}', expected 'NAME in FILE: ABOUT'`);
  const places = [];
  const reason = [];
  for (const line of lines) {
    const [, first, file, occurrence = 1, occurrences = 1] = heading.exec(line) ?? [];
    const sign = line[0];
    if (line === lines[0] || first === 'and')
      places.push({ file: file.startsWith('fuzz/') ? file : `${sources}/${file}`, occurrence: Number(occurrence), occurrences: Number(occurrences), before: '', after: '' });
    else if (sign === '-') places.at(-1).before = `${places.at(-1).before} ${line.slice(1)}`.trim();
    else if (sign === '+') places.at(-1).after = `${places.at(-1).after}\n${line.slice(1).trim()}`.trim();
    else if (sign === '=') reason.push(line.slice(1).trim());
    else throw new Error(`${name}: found '${line}', expected a line that starts with -, + or =`);
  }
  return { name, about, group, places, reason: reason.join(' ') };
}

/**
 * All defects of the lists in a folder, in order. Their files are in the folder `sources`, unless their names
 * begin with fuzz/.
 */
export function readDefects(folder = path.join(here, 'defects'), sources = 'oracle') {
  const defects = [];
  let group = '';
  const lists = readdirSync(folder).filter((name) => name.endsWith('.txt')).sort();
  const text = lists.map((name) => readFileSync(path.join(folder, name), 'utf8')).join('\n\n');
  for (const block of text.split(/\n\s*\n/)) {
    const lines = block.split('\n').filter((line) => line.trim() !== '' && !line.startsWith('#'));
    const title = /^== (.+) ==$/.exec(lines[0] ?? '');
    if (title) group = title[1];
    else if (lines.length > 0) defects.push(parseDefect(lines, group, sources));
  }
  const names = new Set();
  for (const { name } of defects) {
    if (names.has(name)) throw new Error(`${name} stands in the list twice`);
    names.add(name);
  }
  return defects;
}

/** A place with its offset and length in the text. Blanks and line ends in `before` match any others. */
function found(name, place, text) {
  const words = place.before.split(/\s+/).map((word) => word.replace(/[.*+?^${}()|[\]\\]/g, '\\$&'));
  const matches = [...text.matchAll(new RegExp(words.join('\\s+'), 'g'))];
  if (matches.length !== place.occurrences)
    throw new Error(
      `${name}: '${place.before}' occurs ${matches.length} times in ${place.file}, expected ${place.occurrences}`);
  const { index, 0: { length } } = matches[place.occurrence - 1];
  return { ...place, index, length };
}

/** The text of a file with the defect. */
export function applied({ name, places }, file, text) {
  return places.filter((place) => place.file === file).map((place) => found(name, place, text))
    .sort((a, b) => b.index - a.index)
    .reduce((made, { index, length, after }) => made.slice(0, index) + after + made.slice(index + length), text);
}

/** The files that a defect changes. */
export const filesOf = ({ places }) => [...new Set(places.map(({ file }) => file))];
