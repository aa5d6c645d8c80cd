// Questions to Python while something is dragged: one under way, the last position wins.

const PATIENCE = 1500; // milliseconds without an answer, after which a question is asked again
const MOST_REPEATS = 9; // each after twice the time of the one before: for a quarter of an hour

/**
 * A question or its answer can get lost: before the kernel's channel is open, while a lost connection
 * is made anew, in a server that sheds load. So it is asked again, under the same number: whoever has
 * answered it says the same once more and computes nothing.
 * @param {(values: object, id: number) => void} send may raise while there is no connection
 * @param {{patience?: number, repeated?: (times: number) => void, later?: typeof setTimeout, never?: typeof clearTimeout}} how
 *   `repeated` hears of each time that a question is asked again
 */
export function asker(send, how = {}) {
  const { patience = PATIENCE, repeated = () => {}, later = (f, ms) => setTimeout(f, ms), never = (t) => clearTimeout(t) } = how;
  let [busy, wanted, id, sent, timer, stopped] = [false, null, 0, null, null, false];
  const put = (repeats) => {
    timer = repeats < MOST_REPEATS ? later(() => { repeated(repeats + 1); put(repeats + 1); }, patience * 2 ** repeats) : null;
    try { send(sent, id); } catch { /* no connection at this moment: it is asked again */ }
  };
  const go = () => {
    if (busy || stopped || wanted === null) return;
    [busy, sent, wanted] = [true, wanted, null];
    id += 1;
    put(0);
  };
  return {
    /** @param {object} values for which a film is wanted; those that wait are forgotten */
    ask(values) {
      wanted = values;
      if (busy && timer === null) busy = false; // given up on
      go();
    },
    /** An answer came, or none will: the next question may go. @param {number} which */
    answered(which) {
      if (which !== id || !busy) return;
      never(timer);
      busy = false;
      go();
    },
    /** Nothing is asked any more. */
    stop() { never(timer); stopped = true; },
    get busy() { return busy; },
    /** The values of the last question: those of its answer. */
    get sent() { return sent; },
  };
}

const along = (moved, direction) => moved[0] * direction[0] + moved[1] * direction[1] + moved[2] * direction[2];

/** A knob's value after a hand moved by so much of the world along its direction. */
export function draggedValue(knob, value, moved, direction, scale, gain = 1) {
  return rounded(knob, value + (gain * along(moved, direction)) / scale);
}

/**
 * What a knob has to change for what is held to follow, over what the hand's direction says: an
 * arrow that starts elsewhere when it is longer moves less than it grows. Learned from two films.
 * @param {number} gain as it is known @param {number} changed of the knob between the films
 * @param {number[]} moved of what is held @param {number} least change of the knob that tells anything
 */
export function learnedGain(gain, changed, moved, direction, scale, least) {
  const followed = along(moved, direction) / scale;
  // What does not follow, or runs the other way, teaches nothing.
  if (Math.abs(changed) < least || changed * followed <= 0) return gain;
  return Math.min(8, Math.max(0.125, changed / followed));
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
