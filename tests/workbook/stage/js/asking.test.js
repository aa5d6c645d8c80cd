import assert from "node:assert/strict";
import test from "node:test";

import { asker } from "../../../../course/workbook/stage/js/asking.js";

/** An asker with a clock of the test's own; `sent` is what went out. */
function asking(send = () => {}) {
  let now = 0;
  const [sent, waiting, heard] = [[], [], []];
  const questions = asker((values, id) => { sent.push([values, id]); send(sent.length); }, {
    patience: 100,
    repeated: (times) => heard.push(times),
    later: (act, ms) => { const timer = { act, at: now + ms }; waiting.push(timer); return timer; },
    never: (timer) => { if (timer) timer.at = Infinity; },
  });
  const passes = (ms) => {
    const until = now + ms;
    for (;;) {
      const next = waiting.filter((t) => t.at <= until).sort((a, b) => a.at - b.at)[0];
      if (!next) break;
      now = next.at;
      next.at = Infinity;
      next.act();
    }
    now = until;
  };
  return { questions, sent, heard, passes };
}

test("one question is under way, and the last position wins", () => {
  const { questions, sent, passes } = asking();
  for (let k = 0; k < 10; k += 1) questions.ask({ k });
  assert.deepEqual(sent, [[{ k: 0 }, 1]]);
  questions.answered(1);
  assert.deepEqual(sent[1], [{ k: 9 }, 2]);
  questions.answered(1); // late, of another question
  questions.ask({ k: 10 });
  assert.equal(sent.length, 2);
  questions.answered(2);
  assert.deepEqual(sent[2], [{ k: 10 }, 3]);
  questions.answered(3);
  passes(1e9);
  assert.equal(sent.length, 3, "what is answered is asked again");
  questions.answered(3);
  questions.ask({ k: 11 });
  assert.equal(sent.length, 4);
});

test("a question without an answer is asked again under its number, then the last position", () => {
  const { questions, sent, heard, passes } = asking();
  questions.ask({ k: 0 });
  questions.ask({ k: 1 });
  passes(99);
  assert.equal(sent.length, 1);
  passes(1);
  assert.deepEqual(sent[1], [{ k: 0 }, 1]);
  passes(199);
  assert.equal(sent.length, 2, "ever more often");
  passes(1);
  assert.equal(sent.length, 3);
  assert.deepEqual(heard, [1, 2]);
  questions.answered(1);
  assert.deepEqual(sent[3], [{ k: 1 }, 2]);
});

test("what cannot be sent at this moment is sent later", () => {
  const { questions, sent, passes } = asking((count) => { if (count < 3) throw new Error("Cannot send"); });
  questions.ask({ k: 0 });
  passes(300);
  assert.equal(sent.length, 3);
  questions.answered(1);
  assert.equal(questions.busy, false);
});

test("where nobody answers it ends, and what is asked after that is sent at once", () => {
  const { questions, sent, passes } = asking();
  questions.ask({ k: 0 });
  passes(1e9);
  assert.equal(sent.length, 10);
  questions.ask({ k: 1 });
  assert.deepEqual(sent[10], [{ k: 1 }, 2]);
});

test("a stage that is taken away asks nothing more", () => {
  const { questions, sent, passes } = asking();
  questions.ask({ k: 0 });
  questions.stop();
  questions.ask({ k: 1 });
  questions.answered(1);
  passes(1e9);
  assert.equal(sent.length, 1);
});
