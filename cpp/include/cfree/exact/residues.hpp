// The integers modulo an odd prime below 2^62; x is stored as the word x 2^64 (Montgomery's form).
#pragma once
#include "cfree/exact/number.hpp"

namespace cfree {

class Residues {
public:
    using Word = std::uint64_t;
    explicit Residues(Word prime);
    Word of(const Int& n) const;
    Word plus(Word x, Word y) const { return x + y >= p ? x + y - p : x + y; }
    Word minus(Word x, Word y) const { return x >= y ? x - y : x + p - y; }
    Word times(Word x, Word y) const {
        const Wide z = static_cast<Wide>(x) * y, m = static_cast<Wide>(static_cast<Word>(z) * inverse_of_p) * p;
        return minus(static_cast<Word>(z >> 64), static_cast<Word>(m >> 64));
    }
    Word power(Word x, Word exponent) const;
    Word inverse(Word x) const { return power(x, p - 2); }  // zero for zero
    Int value(Word x) const { return times(x, 1); }  // from 0 to p - 1
    Word modulus() const { return p; }
    bool is_prime() const;  // of the modulus

private:
    Word p, inverse_of_p, one, square;  // one: 2^64 modulo p; square: its square
};

// The integers modulo the k-th largest prime below 2^62.
const Residues& large_field(std::size_t k);

// One of these integers, with a pointer to the others.
struct Residue {
    Residues::Word x;
    const Residues* in;
};
inline Residue operator+(const Residue& p, const Residue& q) { return {p.in->plus(p.x, q.x), p.in}; }
inline Residue operator-(const Residue& p, const Residue& q) { return {p.in->minus(p.x, q.x), p.in}; }
inline Residue operator-(const Residue& p) { return {p.in->minus(0, p.x), p.in}; }
inline Residue operator*(const Residue& p, const Residue& q) { return {p.in->times(p.x, q.x), p.in}; }

}  // namespace cfree
