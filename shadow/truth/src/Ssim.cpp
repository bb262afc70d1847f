#include "Ssim.h"

#include <cmath>

namespace gnomon::truth {

Plane ssim(const Plane& a, const Plane& b) {
    constexpr int reach = 5;
    std::vector<float> kernel;
    float sum = 0.0F;
    for (int k = -reach; k <= reach; ++k) {
        kernel.push_back(std::exp(-static_cast<float>(k * k) / (2.0F * 1.5F * 1.5F)));
        sum += kernel.back();
    }
    for (float& weight : kernel) weight /= sum;
    const auto product = [](const Plane& p, const Plane& q) {
        Plane made = p;
        for (std::size_t i = 0; i < made.values.size(); ++i) made.values[i] *= q.values[i];
        return made;
    };
    const Plane meanA = separable(a, kernel, kernel);
    const Plane meanB = separable(b, kernel, kernel);
    const Plane squareA = separable(product(a, a), kernel, kernel);
    const Plane squareB = separable(product(b, b), kernel, kernel);
    const Plane both = separable(product(a, b), kernel, kernel);
    constexpr float c1 = 0.01F * 0.01F;
    constexpr float c2 = 0.03F * 0.03F;
    Plane done = a;
    for (std::size_t i = 0; i < done.values.size(); ++i) {
        const float ma = meanA.values[i];
        const float mb = meanB.values[i];
        const float varA = squareA.values[i] - ma * ma;
        const float varB = squareB.values[i] - mb * mb;
        const float joint = both.values[i] - ma * mb;
        done.values[i] = ((2.0F * ma * mb + c1) * (2.0F * joint + c2)) /
                         ((ma * ma + mb * mb + c1) * (varA + varB + c2));
    }
    return done;
}

}  // namespace gnomon::truth
