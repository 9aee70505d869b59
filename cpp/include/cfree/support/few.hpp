// Up to N values in place, constructed only when added: angles are large objects, and most lists of them are empty.
#pragma once
#include <algorithm>
#include <stdexcept>
#include <type_traits>

namespace cfree {

template <class T, int N>
class Few {
    static_assert(std::is_trivially_copyable_v<T> && std::is_trivially_destructible_v<T>);

public:
    Few() {}
    Few(const Few& other) : count(other.count) { std::copy(other.begin(), other.end(), items); }
    Few& operator=(const Few& other) {
        count = other.count;
        std::copy(other.begin(), other.end(), items);
        return *this;
    }
    void push_back(const T& value) {
        if (count == N) throw std::logic_error("more than there can be");
        items[count++] = value;
    }
    int size() const { return count; }
    bool empty() const { return count == 0; }
    T& operator[](int k) { return items[k]; }
    const T& operator[](int k) const { return items[k]; }
    const T& back() const { return items[count - 1]; }
    const T* begin() const { return items; }
    const T* end() const { return items + count; }
    // Insert before position `at`; later values move up.
    void insert(int at, const T& value) {
        push_back(value);
        std::rotate(items + at, items + count - 1, items + count);
    }

private:
    int count = 0;
    union {
        T items[N];
    };
};

}  // namespace cfree
