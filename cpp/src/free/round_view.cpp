// Exact signs at a rational pose among grown shapes: intervals first, then square roots; theory, "Rounded shapes".
#include "free/round_view.hpp"

#include "cfree/contact/contact_line.hpp"
#include "cfree/exact/radicals.hpp"

namespace cfree {

namespace {

// The angle p / r as a root.
LongRoot root_at(const Int& p, const Int& r) {
    const LongPoly line{-p, r};
    Dyadic lo = Dyadic::from(-1), hi = Dyadic::from(1);
    const Dyadic whole = Dyadic::from(ratio(p, r));
    if (whole.n * r == p << whole.k) lo = hi = whole;
    return {line, lo, hi};
}

Ball nearest_ball(const Int& n, const Int& d) {
    const double value = ratio(n, d);
    return {value, 0, std::abs(value) * 0x1p-52 + tiny};
}

}  // namespace

RoundView::RoundView(const Scene& s, const ExactPose& q, double lo, double hi)
    : scene(s), pose(q), near{lo, hi, q.chart ? -1.0 : 1.0},
      place{nearest_ball(q.X, q.W << static_cast<unsigned>(s.shift)), nearest_ball(q.Y, q.W << static_cast<unsigned>(s.shift))},
      at(s, q.chart, lo, hi, [&q] { return root_at(q.p, q.r); }) {}

template <class K>
MovingVector<K> RoundView::from(const Feature& contact) const {
    const MovingVector<K> site = position<K>(scene, RoundSurfaces<K>(scene).site(contact));
    if constexpr (std::is_same_v<K, Ball>) {
        return {{place.x - site.p.x, place.y - site.p.y}, {Ball(0.0) - site.q.x, Ball(0.0) - site.q.y}};
    } else {
        const K W(pose.W);
        return {{K(pose.X) - W * site.p.x, K(pose.Y) - W * site.p.y}, {-(W * site.q.x), -(W * site.q.y)}};
    }
}

// Forms in balls are over W.
template <class F>
int RoundView::sign(const F& form) {
    const Bounds quick = near(form.template operator()<Ball>(RoundSurfaces<Ball>(scene), Ball(1.0)));
    if (quick.lo > 0) return 1;
    if (quick.hi < 0) return -1;
    return sign_at(AsSurdPoly{near.kappa}(form.template operator()<RootSum>(RoundSurfaces<RootSum>(scene), RootSum(pose.W))), at.here());
}

int RoundView::side(const Feature& contact) {
    return sign([&]<class K>(const RoundSurfaces<K>& of, const K& W) {
        const auto d = from<K>(contact);
        if (is_line(contact)) return cross(of.along(contact), d) + W * (of.rho(contact) * of.length(contact));
        const K rho = W * of.rho(contact);
        return -dot(d, d) + rho * rho;
    });
}

int RoundView::height(const Feature& contact, const Feature& curve, bool is_after) {
    const RoundSpot spot = at.spot(contact, curve, is_after);
    if (!spot.jumps && !spot.is_limit) {
        const auto t = place_of_curve<Ball>(scene, contact, curve, 0, near);
        const auto p = plane_point<Ball>(scene, contact, t, is_line(contact) ? t : place_of_curve<Ball>(scene, contact, curve, 1, near), near);
        Bounds y = p.y.a - bounds(place.y) * p.c;
        if (p.has_root) y = y + p.y.b * sqrt(p.d);
        if (y.lo > 0 || y.hi < 0)
            if (p.c.lo > 0 || p.c.hi < 0) return (y.lo > 0) == (p.c.lo > 0) ? 1 : -1;
    }
    const auto t = at.place_exactly(contact, spot, 0);
    const AsSurdPoly in{near.kappa};
    const auto p = plane_point<RootSum>(scene, contact, t, is_line(contact) ? t : at.place_exactly(contact, spot, 1), in);
    const SurdPoly W = in.number(RootSum(pose.W)), Y = in.number(RootSum(pose.Y));
    return sign_at(Radicals{W * p.y.a - Y * p.c, W * p.y.b, p.d, {}, {}, {}}, at.here()) * sign_at(p.c, at.here());
}

bool RoundView::is_right_of(const Feature& circle) {
    const int beyond_centre = sign([&]<class K>(const RoundSurfaces<K>& of, const K&) { return dot(from<K>(circle), of.axis(0)); });
    const bool is_right_half = (circle.branch == 0 || circle.branch == 3) != is_concave(scene, circle);
    return is_right_half ? beyond_centre > 0 && side(circle) < 0 : beyond_centre >= 0 || side(circle) > 0;
}

Int RoundView::value(const Trig<RootSum>& f) const {
    const Rotation<Int> R = rotation_by(pose.chart, pose.p, pose.r);
    return f.a.c[0] * R.w + f.b.c[0] * R.c + f.c.c[0] * R.s;
}

bool RoundView::is_between(const Feature& contact, const Feature& lower, const Feature& upper, bool is_after) {
    const RoundSurfaces<RootSum> of(scene);
    const auto d = from<RootSum>(contact);
    const Int w = rotation_by(pose.chart, pose.p, pose.r).w * pose.W;
    Ratio t;
    if (is_line(contact)) {
        t = {value(dot(of.along(contact), d)), w * of.square_of_length(contact).c[0]};
    } else {
        const Quadrant ends = quadrant_of(scene, contact);
        const int sign = is_concave(scene, contact) ? -1 : 1;  // d points against u
        const Int start = sign * value(dot(d, of.axis(ends.begin))), end = sign * value(dot(d, of.axis(ends.end)));
        if (start.sign() < 0 || end.sign() < 0) return false;
        t = {end, w * of.size(contact).c[0]};
    }
    const RoundSpot here{contact, {}, 0, false, is_after, false, t};
    return at.order(contact, at.spot(contact, lower, is_after), here) <= 0 && at.order(contact, here, at.spot(contact, upper, is_after)) <= 0;
}

int RoundView::order(LongRoot angle) const { return sign_at(LongPoly{-pose.p, pose.r}, angle); }

}  // namespace cfree
