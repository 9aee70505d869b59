import assert from "node:assert/strict";
import { test } from "node:test";
import { decimal, float, fraction, is_less, minus, over, plus, root, text, times } from "../src/fraction.ts";

test("decimals are read and written exactly", () => {
  for (const [from, to] of [
    ["1", "1"],
    ["-0.50", "-0.5"],
    ["+.125", "0.125"],
    ["1e3", "1000"],
    ["25e-3", "0.025"],
    ["0.1", "0.1"],
    ["-7.", "-7"],
  ])
    assert.equal(text(decimal(from)), to);
  for (const none of ["", ".", "e3", "1e", "0x10", "1 2", "1e99999", "9".repeat(401)])
    assert.equal(decimal(none), undefined);
  assert.equal(text(fraction(6n, -4n)), "-1.5");
  assert.equal(text(fraction(1n, 3n)), "1/3");
});

test("sums, products and quotients are exact, and roots of squares", () => {
  const [a, b] = [decimal("0.1"), decimal("0.2")];
  assert.equal(text(plus(a, b)), "0.3");
  assert.equal(text(minus(a, b)), "-0.1");
  assert.equal(text(times(a, b)), "0.02");
  assert.equal(text(over(a, decimal("0.3"))), "1/3");
  assert.throws(() => over(a, decimal("0")), /division by 0/);
  assert.equal(text(root(decimal("0.0225"))), "0.15");
  assert.equal(root(decimal("2")), undefined);
  assert.equal(root(decimal("-4")), undefined);
  assert.equal(text(root(fraction(10n ** 60n))), text(fraction(10n ** 30n)));
  assert.ok(is_less(a, b) && !is_less(b, a));
  assert.equal(float(over(fraction(10n ** 400n), fraction(3n * 10n ** 400n))), 1 / 3);
});
