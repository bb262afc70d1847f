#pragma once

#include <gnomon/math/Types.h>

#include <random>

namespace gnomon::shadow_fit {

/// Numbers that are the same for the same seed.
class Chance {
public:
    explicit Chance(unsigned seed) : random_{seed} {}
    double between(double low, double high) {
        return std::uniform_real_distribution<double>{low, high}(random_);
    }
    math::dvec3 point(const math::dvec3& low, const math::dvec3& high) {
        return {between(low.x, high.x), between(low.y, high.y), between(low.z, high.z)};
    }
    math::dvec3 direction() {
        std::normal_distribution<double> g;
        return glm::normalize(math::dvec3{g(random_), g(random_), g(random_)});
    }
    bool coin() { return between(0.0, 1.0) < 0.5; }
    /// 0 to count - 1.
    int one(int count) { return std::uniform_int_distribution<int>{0, count - 1}(random_); }

private:
    std::mt19937 random_;
};

}  // namespace gnomon::shadow_fit
