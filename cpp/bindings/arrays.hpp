// NumPy's arrays and the core's vectors.
#pragma once
#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>

#include <span>
#include <stdexcept>
#include <vector>

namespace nb = nanobind;

template <class T, int rank>
using In = nb::ndarray<const T, nb::ndim<rank>, nb::c_contig, nb::device::cpu>;
template <class T>
using Column = In<T, 1>;
template <class T, int rank>
using Out = nb::ndarray<T, nb::ndim<rank>, nb::c_contig, nb::device::cpu>;
template <class T, int rank = 1>
using Made = nb::ndarray<nb::numpy, T, nb::ndim<rank>>;

template <class T>
std::vector<T> vector_of(const Column<T>& column) {
    return {column.data(), column.data() + column.shape(0)};
}

// The vector's memory as an array that owns it.
template <class T>
Made<T> array_of(std::vector<T>&& values) {
    auto* kept = new std::vector<T>(std::move(values));
    nb::capsule owner(kept, [](void* p) noexcept { delete static_cast<std::vector<T>*>(p); });
    return {kept->data(), {kept->size()}, owner};
}

// Properties that are read-only views of a value's memory, which they keep alive.
template <class C, class T>
void column(nb::class_<C>& to, const char* name, std::vector<T> C::* member) {
    to.def_prop_ro(name, [member](const C& x) { return Made<const T>((x.*member).data(), {(x.*member).size()}); });
}
// Rows of `width` numbers.
template <std::size_t width, class C, class T>
void rows(nb::class_<C>& to, const char* name, std::vector<T> C::* member) {
    to.def_prop_ro(name, [member](const C& x) {
        return Made<const T, 2>((x.*member).data(), {(x.*member).size() / width, width});
    });
}

inline void require(bool fits, const char* otherwise) {
    if (!fits) throw std::invalid_argument(otherwise);
}
