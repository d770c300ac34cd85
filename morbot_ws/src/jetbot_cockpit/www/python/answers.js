// What a program's worker may answer. Whoever has written the program, the page takes nothing else from it.

const [MOST_EVENTS, MOST_VARIABLES] = [100, 100]; // in an answer
const MOST_CHARACTERS = 200000; // of all variables
const [LONGEST, LONGEST_NAME] = [10000, 100]; // characters of a text; of a variable's name and value

const isNumber = (value) => typeof value === "number";
const isText = (value) => typeof value === "string";
const text = (value, longest = LONGEST) => (isText(value) ? value.slice(0, longest) : "");

// Each kind of event: whether it is one, and what of it counts
/** @type {[(event: any) => boolean, (event: any) => object][]} */
const KINDS = [
  [({ step }) => Number.isInteger(step), ({ step }) => ({ step })],
  [({ wait }) => isNumber(wait), ({ wait }) => ({ wait })],
  [({ breathe }) => breathe === true, () => ({ breathe: true })],
  [({ print }) => isText(print), ({ print }) => ({ print: text(print) })],
  [({ name, value }) => isText(name) && isNumber(value), ({ name, value }) => ({ name: text(name), value })],
  [({ motion }) => Array.isArray(motion) && motion.every(isNumber),
    ({ motion: [x = 0, z = 0] }) => ({ motion: [x, z] })],
];

// Returns the answer with nothing in it but what an engine understands.
export function checked(answer) {
  const { events, variables, over, problem, broken } = answer ?? {};
  const list = Array.isArray(events) ? events.slice(0, MOST_EVENTS) : [];
  return {
    events: list.flatMap((event) => KINDS.find(([is]) => is(event ?? {}))?.[1](event) ?? []),
    variables: toVariables(variables),
    over: over === true,
    problem: problem && toProblem(problem),
    broken: text(broken),
  };
}

function toProblem({ type, message, line, marked }) {
  return { type: text(type), message: text(message), line: Number(line), marked: Number(marked) };
}

// Returns texts by names; null: nothing is known
function toVariables(variables) {
  if (!isText(variables) || variables.length > MOST_CHARACTERS) return null;
  const pairs = JSON.parse(variables).slice(0, MOST_VARIABLES);
  return new Map(pairs.map(([name, value]) => [text(name, LONGEST_NAME), text(value, LONGEST_NAME)]));
}
