// Answer of a call, taken from outside column by column: a name, a type, bytes.
#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace cfree {

class Reply {
public:
    enum class Type : int { bytes, integers, doubles, text };
    struct Column {
        std::string name;
        Type type;
        std::vector<std::uint8_t> bytes;
    };

    void add(const std::string& name, const std::vector<double>& values) { put(name, Type::doubles, values); }
    void add(const std::string& name, const std::vector<std::int32_t>& values) { put(name, Type::integers, values); }
    void add(const std::string& name, const std::vector<std::uint8_t>& values) { put(name, Type::bytes, values); }
    void add(const std::string& name, const std::vector<std::uint64_t>& values) { put(name, Type::bytes, values); }
    void add(const std::string& name, double value) { add(name, std::vector<double>{value}); }
    void text(const std::string& name, std::string_view value) {
        columns.push_back({name, Type::text, {value.begin(), value.end()}});
    }

    std::vector<Column> columns;

private:
    template <class T>
    void put(const std::string& name, Type type, const std::vector<T>& values) {
        const auto* from = reinterpret_cast<const std::uint8_t*>(values.data());
        columns.push_back({name, type, {from, from + values.size() * sizeof(T)}});
    }
};

}  // namespace cfree
