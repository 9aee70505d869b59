// Products and inverses modulo a prime, without divisions; theory, "Closed surfaces".
#include "cfree/exact/residues.hpp"

namespace cfree {

Residues::Residues(Word prime) : p(prime), inverse_of_p(prime) {
    for (int k = 0; k < 5; ++k) inverse_of_p *= 2 - p * inverse_of_p;  // Newton's method: 3 bits are right, 6, 12, ...
    one = static_cast<Word>((Wide(1) << 64) % p), square = static_cast<Word>(static_cast<Wide>(one) * one % p);
}

Residues::Word Residues::of(const Int& n) const {
    const Int r = n % Int(p);
    return times(static_cast<Word>(r.sign() < 0 ? Int(r + p) : r), square);
}

Residues::Word Residues::inverse(Word x) const {  // x^(p - 2)
    Word result = one;
    for (Word e = p - 2; e != 0; e >>= 1, x = times(x, x))
        if (e & 1) result = times(result, x);
    return result;
}

}  // namespace cfree
