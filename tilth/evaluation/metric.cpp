#include <algorithm>
#include <cmath>

#include <tilth/core/error.hpp>
#include <tilth/evaluation/metric.hpp>

namespace tilth {
namespace {

double median_of(std::vector<double> values) {
  const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1) return *middle;
  return (*std::max_element(values.begin(), middle) + *middle) / 2;
}

}  // namespace

Metric metric_of(std::vector<double> errors) {
  if (errors.empty()) throw Error("metric", "there is no error to make statistics of");
  const double n = double(errors.size());
  Metric metric;
  double sum = 0;
  for (const double e : errors) {
    sum += e;
    metric.sse += e * e;
  }
  metric.mean = sum / n;
  metric.rmse = std::sqrt(metric.sse / n);
  double spread = 0;
  for (const double e : errors) spread += (e - metric.mean) * (e - metric.mean);
  metric.std = std::sqrt(spread / n);
  metric.median = median_of(errors);
  const auto [least, most] = std::minmax_element(errors.begin(), errors.end());
  metric.min = *least;
  metric.max = *most;
  metric.errors = std::move(errors);
  return metric;
}

Metric scaled(const Metric& metric, double factor) {
  std::vector<double> errors = metric.errors;
  for (double& e : errors) e *= factor;
  return metric_of(std::move(errors));
}

}  // namespace tilth
