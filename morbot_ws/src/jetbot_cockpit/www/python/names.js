// The names that a Python program knows.

import { KEYWORDS, readStatements, VALUES } from "./tokens.js";

/** @import { Token } from "./tokens.js" */

export const BUILTINS = [...KEYWORDS, ...VALUES, ...("abs all any bin bool chr dict dir divmod enumerate filter float "
  + "format frozenset getattr hasattr hex id input int isinstance issubclass iter len list map max min next object "
  + "open ord pow print property range repr reversed round set setattr sorted str sum super tuple type zip Exception "
  + "IndexError KeyError TypeError ValueError ZeroDivisionError").split(" ")];

// The modules of the page, and what else a program often takes from them
export const MODULES = ("rospy geometry_msgs std_msgs nav_msgs sensor_msgs math random time sys json collections copy "
  + "datetime functools itertools operator re string struct").split(" ");
const FROM = new Map(Object.entries({
  "geometry_msgs.msg": "Twist Vector3 Point Quaternion Pose Pose2D", "nav_msgs.msg": "Odometry",
  "std_msgs.msg": "Bool String Int32 Float32 Float64 Float32MultiArray Header Empty",
  math: "sin cos tan atan2 sqrt pi hypot radians degrees floor ceil", time: "sleep",
  random: "randint choice shuffle uniform", rospy: "Publisher Subscriber Rate init_node is_shutdown loginfo",
}).flatMap(([module, names]) => names.split(" ").map((name) => [name, `from ${module} import ${name}`])));

// The attributes of what a program has to do with here
export const ATTRIBUTES = (
  "linear angular x y z w data pose position orientation twist theta header stamp publish sleep append insert "
  + "pop remove sort index count extend reverse clear keys values items get update lower upper split strip join "
  + "format replace find startswith endswith add init_node is_shutdown Publisher Subscriber Rate loginfo logwarn "
  + "logerr get_time get_param wait_for_message spin on_shutdown Duration Time now to_sec sin cos tan asin acos "
  + "atan atan2 sqrt pi tau hypot floor ceil radians degrees fabs exp log randint random choice shuffle uniform "
  + "time monotonic Twist Vector3 Point Pose Odometry Float32 Float64 Float32MultiArray String Bool Int32 msg"
).split(" ");

// Returns the line that imports this name, or undefined.
/** @param {string} name */
export const importOf = (name) => (MODULES.includes(name) ? `import ${name}` : FROM.get(name));

// Returns the names to which a program gives a value, and whether it does so outside of functions.
/** @param {string} source @returns {Map<string, boolean>} */
export function boundNames(source) {
  const bound = new Map();
  for (const { tokens, indent } of readStatements(source).statements) {
    for (const name of namesBoundBy(tokens)) bound.set(name, bound.get(name) || !indent);
    if (tokens[0].text === "def") for (const name of parameters(tokens)) bound.set(name, bound.get(name) ?? false);
  }
  return bound;
}

// Yields the names to which this statement gives a value.
/** @param {Token[]} tokens */
export function *namesBoundBy(tokens) {
  const last = tokens.findLastIndex(({ text, opener }) => /^([^=!<>]|\/\/|<<|>>|\*\*)?=$/.test(text) && !opener);
  for (const [index, { kind, text, opener }] of tokens.entries()) {
    const before = tokens[index - 1]?.text;
    const target = index < last && before !== "." && !opener?.call && tokens[index + 1]?.kind !== "open";
    const named = ["def", "class", "as", "import", "for", "global"].includes(before);
    if (kind === "name" && (target || named || inList(tokens, index))) yield text;
  }
}

// Whether this is one of the names in "import a, b" or "for a, b in".
function inList(tokens, index) {
  const before = tokens.slice(0, index).findLastIndex(({ kind, text }) => kind !== "name" && text !== ",");
  return tokens[index - 1]?.text === "," && ["import", "for", "global"].includes(tokens[before]?.text);
}

function parameters(tokens) {
  const end = tokens.findIndex(({ kind, opener }) => kind === "close" && !opener);
  return tokens.slice(2, end).filter(({ kind }) => kind === "name").map(({ text }) => text);
}

// Returns the names of the attributes and functions that a program itself makes.
/** @param {string} source */
export const methodsOf = (source) => [...source.matchAll(/\b(?:self\.|def )(\w+)/g)].map(([, name]) => name);
