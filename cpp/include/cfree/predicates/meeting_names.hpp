// Names of the features that meet at an angle, in a hash table with open addresses: one angle may have many thousands.
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "cfree/predicates/predicates.hpp"

namespace cfree {

class MeetingNames {
public:
    using Name = std::array<Code, 3>;

    bool contains(const Name& name) const { return !slots.empty() && !is_empty(slots[place(name)]); }
    // True if the name is new.
    bool insert(const Name& name) {
        if (2 * (count + 1) > slots.size()) grow();
        Name& slot = slots[place(name)];
        if (!is_empty(slot)) return false;
        slot = name;
        ++count;
        return true;
    }

private:
    static constexpr Name empty{~Code{0}, ~Code{0}, ~Code{0}};  // three codes that no feature has
    static bool is_empty(const Name& name) { return name[2] == empty[2]; }
    std::vector<Name> slots;  // a power of two
    std::size_t count = 0;

    // Slot of a name, or the slot for it.
    std::size_t place(const Name& name) const {
        std::uint64_t mixed = 0;
        for (const Code part : name) mixed = (mixed ^ part) * 0x9e3779b97f4a7c15, mixed ^= mixed >> 32;
        std::size_t k = mixed & (slots.size() - 1);
        const auto is_it = [&](const Name& slot) { return slot[2] == name[2] && slot[1] == name[1] && slot[0] == name[0]; };
        while (!is_empty(slots[k]) && !is_it(slots[k])) k = (k + 1) & (slots.size() - 1);
        return k;
    }
    void grow() {
        std::vector<Name> before(slots.empty() ? 16 : 2 * slots.size(), empty);
        before.swap(slots);
        for (const Name& name : before)
            if (!is_empty(name)) slots[place(name)] = name;
    }
};

}  // namespace cfree
