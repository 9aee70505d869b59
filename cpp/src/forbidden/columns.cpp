// Trapezoids as columns, with one name for each feature; theory, "Surfaces that coincide".
#include "cfree/forbidden/columns.hpp"

namespace cfree {

void Trapezoids::reserve(std::size_t count) {
    patch.reserve(count), chart.reserve(count);
    for (auto* v : {&lower, &upper, &from_first, &from_second, &to_first, &to_second}) v->reserve(count);
    for (auto* v : {&from_lo, &from_hi, &to_lo, &to_hi}) v->reserve(count);
    from_place.reserve(count), to_place.reserve(count);
}

void Trapezoids::push_back(const Trapezoid& x) {
    patch.push_back(x.patch), chart.push_back(static_cast<std::uint8_t>(x.chart));
    lower.push_back(packed(x.lower)), upper.push_back(packed(x.upper));
    from_first.push_back(packed(x.from.first)), from_second.push_back(packed(x.from.second));
    to_first.push_back(packed(x.to.first)), to_second.push_back(packed(x.to.second));
    from_lo.push_back(x.from.lo), from_hi.push_back(x.from.hi);
    to_lo.push_back(x.to.lo), to_hi.push_back(x.to.hi);
    from_place.push_back(static_cast<std::uint8_t>(x.from_place));
    to_place.push_back(static_cast<std::uint8_t>(x.to_place));
}

void Trapezoids::push_row(const Trapezoids& of, Index k) {
    patch.push_back(of.patch[k]), chart.push_back(of.chart[k]), lower.push_back(of.lower[k]), upper.push_back(of.upper[k]);
    from_first.push_back(of.from_first[k]), from_second.push_back(of.from_second[k]);
    to_first.push_back(of.to_first[k]), to_second.push_back(of.to_second[k]);
    from_lo.push_back(of.from_lo[k]), from_hi.push_back(of.from_hi[k]), to_lo.push_back(of.to_lo[k]);
    to_hi.push_back(of.to_hi[k]), from_place.push_back(of.from_place[k]), to_place.push_back(of.to_place[k]);
}

std::uint64_t named(const Representatives& names, std::uint64_t feature) {
    Feature f = unpacked(feature);
    const bool helix = f.kind == Kind::vertex_vertex || f.kind == Kind::seam;
    if (f.kind == Kind::none) return feature;
    f.robot = helix || f.kind == Kind::vertex_edge ? names.vertex(true, f.robot) : names.edge(true, f.robot);
    f.obstacle = helix || f.kind == Kind::edge_vertex ? names.vertex(false, f.obstacle) : names.edge(false, f.obstacle);
    return packed(f);
}

void use_names(const Scene& scene, const std::array<std::vector<std::uint64_t>*, 6>& columns) {
    const Representatives names(scene);
    for (auto* column : columns)
        for (std::uint64_t& feature : *column) feature = named(names, feature);
}

}  // namespace cfree
