#include "KeySampler.h"

#include <algorithm>
#include <cmath>

namespace gnomon::client {
namespace {

using Interpolation = scene::AnimationChannel::Interpolation;

/// Where a time lies between keys.
struct Between {
    std::size_t first = 0;
    std::size_t second = 0;
    double share = 0.0;   ///< of the way from first to second, 0..1
    double length = 0.0;  ///< seconds between the two
};

Between find(std::span<const float> times, double time) noexcept {
    const std::size_t last = times.size() - 1;
    if (!(time > times.front())) return {};
    if (time >= times.back()) return {.first = last, .second = last};
    const auto after = std::upper_bound(times.begin(), times.end(), time,
                                        [](double t, float key) { return t < key; });
    const auto second = static_cast<std::size_t>(after - times.begin());
    const double start = times[second - 1];
    const double length = times[second] - start;  // above 0: start <= time < times[second]
    return {
        .first = second - 1, .second = second, .share = (time - start) / length, .length = length};
}

template <int n>
using Vector = glm::vec<n, double>;

template <int n>
Vector<n> valueAt(std::span<const float> values, std::size_t index) noexcept {
    Vector<n> value;
    for (int i = 0; i < n; ++i)
        value[i] = values[index * static_cast<std::size_t>(n) + static_cast<std::size_t>(i)];
    return value;
}

/// Hermite spline; each key is in-tangent, value, out-tangent.
template <int n>
Vector<n> spline(std::span<const float> values, const Between& at) noexcept {
    const auto from = valueAt<n>(values, at.first * 3 + 1);
    const auto out = valueAt<n>(values, at.first * 3 + 2) * at.length;
    const auto in = valueAt<n>(values, at.second * 3) * at.length;
    const auto to = valueAt<n>(values, at.second * 3 + 1);
    const double t = at.share;
    const double t2 = t * t;
    const double t3 = t2 * t;
    return from * (2.0 * t3 - 3.0 * t2 + 1.0) + out * (t3 - 2.0 * t2 + t) +
           to * (-2.0 * t3 + 3.0 * t2) + in * (t3 - t2);
}

math::dvec4 unit(const math::dvec4& q) noexcept {
    const double length = glm::length(q);
    return length > 0.0 ? q / length : math::dvec4{0.0, 0.0, 0.0, 1.0};
}

math::dvec4 slerp(const math::dvec4& a, math::dvec4 b, double share) noexcept {
    double cosine = glm::dot(a, b);
    if (cosine < 0.0) {
        b = -b;
        cosine = -cosine;
    }
    // So close that the sine would lose its digits, the chord is the arc.
    if (cosine > 0.999999) return unit(a * (1.0 - share) + b * share);
    const double angle = std::acos(cosine);
    return (a * std::sin((1.0 - share) * angle) + b * std::sin(share * angle)) / std::sin(angle);
}

template <int n>
Vector<n> keyValue(const Keys& keys, std::size_t index) noexcept {
    const bool cubic = keys.interpolation == Interpolation::cubicSpline;
    return valueAt<n>(keys.values, cubic ? index * 3 + 1 : index);
}

}  // namespace

bool complete(const Keys& keys, std::size_t components) noexcept {
    const std::size_t each =
        components * (keys.interpolation == Interpolation::cubicSpline ? 3 : 1);
    return !keys.times.empty() && keys.values.size() / each >= keys.times.size();
}

math::dvec3 sampleVector(const Keys& keys, double time) noexcept {
    const Between at = find(keys.times, time);
    if (at.first == at.second || keys.interpolation == Interpolation::step)
        return keyValue<3>(keys, at.first);
    if (keys.interpolation == Interpolation::cubicSpline) return spline<3>(keys.values, at);
    return glm::mix(keyValue<3>(keys, at.first), keyValue<3>(keys, at.second), at.share);
}

math::dvec4 sampleRotation(const Keys& keys, double time) noexcept {
    const Between at = find(keys.times, time);
    if (at.first == at.second || keys.interpolation == Interpolation::step)
        return unit(keyValue<4>(keys, at.first));
    if (keys.interpolation == Interpolation::cubicSpline) return unit(spline<4>(keys.values, at));
    return slerp(unit(keyValue<4>(keys, at.first)), unit(keyValue<4>(keys, at.second)), at.share);
}

}  // namespace gnomon::client
