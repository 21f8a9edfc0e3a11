#include "filter_tracked_mcf/core/field.h"

#include <cmath>

#include "filter_tracked_mcf/core/parallel.h"

namespace tracked_mcf {

double norm(const Field& field) {
    return std::sqrt(parallel_sum(field.cols(), [&](std::int64_t begin, std::int64_t end) {
        double sum = 0;
        for (std::int64_t i = begin; i < end; ++i) sum += field.col(i).cast<double>().squaredNorm();
        return sum;
    }));
}

}  // namespace tracked_mcf
