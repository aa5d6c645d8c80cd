// Questions to Python while something is dragged: one under way, the last position wins.

/** @param {(values: object, id: number) => void} send */
export function asker(send) {
  let [busy, wanted, id] = [false, null, 0];
  const go = () => {
    if (busy || wanted === null) return;
    const values = wanted;
    [busy, wanted] = [true, null];
    id += 1;
    send(values, id);
  };
  return {
    ask(values) { wanted = values; go(); },
    /** An answer came, or none will: the next question may go. */
    answered(which) { if (which === id) { busy = false; go(); } },
    get busy() { return busy; },
  };
}

/** A knob's value after a hand moved by so much of the world along its direction. */
export function draggedValue(knob, value, moved, direction, scale) {
  const along = moved[0] * direction[0] + moved[1] * direction[1] + moved[2] * direction[2];
  return rounded(knob, value + along / scale);
}

/** Within the knob's range, on its steps. */
export function rounded(knob, value) {
  const inside = Math.min(knob.high, Math.max(knob.low, value));
  if (knob.log) return inside;
  const steps = Math.round((inside - knob.low) / knob.step);
  return Number((knob.low + steps * knob.step).toPrecision(12));
}

/** A knob's place from 0 to 1000 on its slider, and back; powers of ten where it says so. */
export function slid(knob, value) {
  const [a, b, v] = knob.log ? [knob.low, knob.high, value].map(Math.log10) : [knob.low, knob.high, value];
  return Math.round((1000 * (v - a)) / (b - a));
}

export function unslid(knob, place) {
  if (knob.log) {
    const [a, b] = [Math.log10(knob.low), Math.log10(knob.high)];
    return Number((10 ** (a + ((b - a) * place) / 1000)).toPrecision(3));
  }
  return rounded(knob, knob.low + ((knob.high - knob.low) * place) / 1000);
}
