// Rational numbers of drawings: decimals are added, multiplied and divided exactly.
export interface Fraction {
  n: bigint;
  d: bigint; // above 0, without a common divisor
}

export function fraction(n: bigint, d = 1n): Fraction {
  if (d === 0n) throw new Error("a division by 0");
  let [divisor, rest] = [n < 0n ? -n : n, d < 0n ? -d : d];
  while (rest) [divisor, rest] = [rest, divisor % rest];
  if (d < 0n) divisor = -divisor;
  return { n: n / divisor, d: d / divisor };
}
export const ZERO = fraction(0n);
export const ONE = fraction(1n);

const MOST_DIGITS = 400;
// Undefined if a text is no decimal, or a very long one.
export function decimal(text: string): Fraction | undefined {
  const parts = /^([-+]?)(\d*)\.?(\d*)(?:[eE]([-+]?\d{1,3}))?$/.exec(text);
  if (!parts || !(parts[2] || parts[3]) || text.length > MOST_DIGITS) return undefined;
  const digits = BigInt(`${parts[2]}${parts[3]}`);
  const power = Number(parts[4] ?? 0) - parts[3]!.length;
  const ten = 10n ** BigInt(Math.abs(power));
  const size = power < 0 ? fraction(digits, ten) : fraction(digits * ten);
  return parts[1] === "-" ? negative(size) : size;
}

export const plus = (a: Fraction, b: Fraction) => fraction(a.n * b.d + b.n * a.d, a.d * b.d);
export const minus = (a: Fraction, b: Fraction) => fraction(a.n * b.d - b.n * a.d, a.d * b.d);
export const times = (a: Fraction, b: Fraction) => fraction(a.n * b.n, a.d * b.d);
export const over = (a: Fraction, b: Fraction) => fraction(a.n * b.d, a.d * b.n);
export const negative = (a: Fraction): Fraction => ({ n: -a.n, d: a.d });
export const is_zero = (a: Fraction) => a.n === 0n;
export const equal = (a: Fraction, b: Fraction) => a.n === b.n && a.d === b.d;
export const is_less = (a: Fraction, b: Fraction) => a.n * b.d < b.n * a.d;

// The nearest double, about.
export function float(a: Fraction): number {
  const [n, d] = [Number(a.n), Number(a.d)];
  if (Number.isFinite(n) && Number.isFinite(d)) return n / d;
  const shift = BigInt(Math.max(0, a.d.toString(2).length - 1000, (a.n < 0n ? -a.n : a.n).toString(2).length - 1000));
  return Number(a.n >> shift) / Number(a.d >> shift);
}

function whole_root(n: bigint): bigint | undefined {
  if (n < 2n) return n < 0n ? undefined : n;
  let root = 1n << BigInt(Math.ceil(n.toString(2).length / 2));
  for (let next = (root + n / root) >> 1n; next < root; next = (root + n / root) >> 1n) root = next;
  return root * root === n ? root : undefined;
}
// The square root; undefined if it is irrational.
export function root(a: Fraction): Fraction | undefined {
  const [n, d] = [whole_root(a.n), whole_root(a.d)];
  return n === undefined || d === undefined ? undefined : fraction(n, d);
}

// A decimal if there is one, else "p/q".
export function text(a: Fraction): string {
  let [rest, twos, fives] = [a.d, 0, 0];
  for (; rest % 2n === 0n; rest /= 2n) ++twos;
  for (; rest % 5n === 0n; rest /= 5n) ++fives;
  if (rest !== 1n) return `${a.n}/${a.d}`;
  const places = Math.max(twos, fives);
  const digits = (((a.n < 0n ? -a.n : a.n) * 10n ** BigInt(places)) / a.d).toString().padStart(places + 1, "0");
  const cut = digits.length - places;
  return `${a.n < 0n ? "-" : ""}${digits.slice(0, cut)}${places ? `.${digits.slice(cut)}` : ""}`;
}
