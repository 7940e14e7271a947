#include "strutt/integrate/taylor_propagator.hpp"

#include "integrate/taylor_step.hpp"
#include "strutt/base/error.hpp"

namespace strutt {
namespace {

std::unique_ptr<TaylorPropagator::Steps> make_steps(const TaylorEquation& equation,
                                                    const TaylorStepPlan& plan, int half_periods) {
  switch (equation.stiffness.mean.rows()) {
    case 2:
      return std::make_unique<detail::TaylorSteps<2>>(equation, plan, half_periods);
    case 3:
      return std::make_unique<detail::TaylorSteps<3>>(equation, plan, half_periods);
    default:
      return std::make_unique<detail::TaylorSteps<Eigen::Dynamic>>(equation, plan, half_periods);
  }
}

}  // namespace

TaylorPropagator::TaylorPropagator(const TaylorEquation& equation, const TaylorStepPlan& plan,
                                   int half_periods)
    : count_(plan.steps) {
  require(plan.order % 2 == 0 && plan.order >= kLowestTaylorOrder && plan.order <= kHighestTaylorOrder,
          "order", plan.order, "even, from 6 to 22");
  require(plan.steps >= 1, "steps", plan.steps, "at least 1");
  require(half_periods == 1 || half_periods == 2, "half_periods", half_periods, "1 or 2");
  steps_ = make_steps(equation, plan, half_periods);
}

TaylorPropagator::~TaylorPropagator() = default;
TaylorPropagator::TaylorPropagator(TaylorPropagator&&) noexcept = default;
TaylorPropagator& TaylorPropagator::operator=(TaylorPropagator&&) noexcept = default;

BoundedMatrix TaylorPropagator::propagate(int first, int last, bool with_truncation) {
  require(first >= 0 && first < count_, "first", first, "one of the steps");
  require(last > first && last <= count_, "last", last, "after `first`, not beyond the plan");
  std::vector<BoundedMatrix> factors;
  for (int index = first; index < last; ++index) factors.push_back(steps_->step(index, with_truncation));
  return ordered_product(factors, static_cast<int>(factors.front().value.mantissa.rows()));
}

long TaylorPropagator::products_per_step() const { return steps_->products(); }

}  // namespace strutt
