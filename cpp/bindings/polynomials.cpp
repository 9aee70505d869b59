// Polynomials and real roots, flat, for tests: they are compared with references in Python.
#include "polynomials.hpp"

#include <stdexcept>

using namespace nb::literals;

static cfree::Poly polynomial(const Coefficients& c) {
    if (c.size() > 5) throw std::invalid_argument("the degree is at most 4");
    cfree::Poly p;
    for (const auto& x : c) p.push_back(integer(x));
    p.trim();
    return p;
}

static cfree::RealRoot root(const RootTuple& x) {
    const auto& [p, lo, hi] = x;
    return {polynomial(p), dyadic(lo), dyadic(hi)};
}

void bind_polynomials(nb::module_& m) {
    m.def("sign_at", [](const Coefficients& p, const DyadicPair& at) {
        return cfree::sign_at(polynomial(p), dyadic(at));
    }, "p"_a, "at"_a);
    m.def("sign_at", [](const Coefficients& p, const RootTuple& at) {
        auto x = root(at);
        return cfree::sign_at(polynomial(p), x);
    }, "p"_a, "at"_a);
    m.def("sign_before", [](const Coefficients& p, const RootTuple& at) {
        auto x = root(at);
        return cfree::sign_before(polynomial(p), x);
    }, "p"_a, "at"_a);
    m.def("sign_after", [](const Coefficients& p, const RootTuple& at) {
        auto x = root(at);
        return cfree::sign_after(polynomial(p), x);
    }, "p"_a, "at"_a);
    m.def("compare", [](const RootTuple& p, const RootTuple& q) {
        auto x = root(p), y = root(q);
        return cfree::compare(x, y);
    }, "x"_a, "y"_a);
    m.def("greatest_common_divisor", [](const Coefficients& p, const Coefficients& q) {
        return integers(cfree::greatest_common_divisor(polynomial(p), polynomial(q)));
    }, "p"_a, "q"_a);
    m.def("squarefree", [](const Coefficients& p) { return integers(cfree::squarefree(polynomial(p))); }, "p"_a);
    m.def("isolate", [](const Coefficients& squarefree, const DyadicPair& lo, const DyadicPair& hi, unsigned bits) {
        std::vector<std::pair<DyadicPair, DyadicPair>> found;
        for (const auto& [l, h] : cfree::isolate(cfree::Sturm(polynomial(squarefree)), dyadic(lo), dyadic(hi), bits))
            found.emplace_back(dyadic(l), dyadic(h));
        return found;
    }, "squarefree"_a, "lo"_a, "hi"_a, "bits"_a);
}
