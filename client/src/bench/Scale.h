#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

namespace gnomon::client {

/// Values to places on one axis of a plot, evenly or by their logarithm, with the values to mark.
class Scale {
public:
    /// @pre first < last; both > 0 where logarithmic
    Scale(double first, double last, double from, double to, bool logarithmic)
        : first_{first}, last_{last}, from_{from}, to_{to}, logarithmic_{logarithmic} {}

    /// Beyond the ends, at the ends.
    double at(double value) const {
        const double v = std::clamp(value, first_, last_);
        const double share = logarithmic_ ? std::log(v / first_) / std::log(last_ / first_)
                                          : (v - first_) / (last_ - first_);
        return from_ + (to_ - from_) * share;
    }
    std::vector<double> ticks() const {
        std::vector<double> all;
        if (!logarithmic_) {
            const double step = roundStep((last_ - first_) / 6.0);
            for (int i = 0; first_ + i * step <= last_ * 1.0001; ++i)
                all.push_back(first_ + i * step);
            return all;
        }
        for (int power = -9; power <= 9; ++power)
            for (const double digit : {1.0, 2.0, 5.0}) {
                const double value = digit * std::pow(10.0, power);
                if (value > first_ * 0.999 && value < last_ * 1.001) all.push_back(value);
            }
        return all;
    }
    /// 1, 2 or 5 times a power of ten, at least that.
    static double roundStep(double raw) {
        const double power = std::pow(10.0, std::floor(std::log10(raw)));
        for (const double step : {1.0, 2.0, 5.0})
            if (step * power >= raw) return step * power;
        return 10.0 * power;
    }

private:
    double first_, last_, from_, to_;
    bool logarithmic_;
};

}  // namespace gnomon::client
