// Numbers that are long, as the curves write them.

// Returns a number of more characters than most by its power of ten, as programs write it, if that is shorter.
/** @param {string} text @param {number} most */
export function shortened(text, most) {
  const short = Number(text).toExponential().replace("e+", "e");
  return text.length > most && short.length < text.length ? short : text;
}
