#include <gtest/gtest.h>

#include <cstdlib>
#include <new>
#include <vector>

#include "trajectory/minco.h"
#include "trajectory/minco_problem.h"

namespace {
std::size_t allocations = 0;
}

void* operator new(std::size_t size) {
  ++allocations;
  if (void* memory = std::malloc(size)) return memory;
  throw std::bad_alloc();
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

namespace mocha {
namespace {

template <typename Case>
class MincoAllocationTest : public ::testing::Test {};
TYPED_TEST_SUITE(MincoAllocationTest, test::AllCases);

TYPED_TEST(MincoAllocationTest, NothingAllocatesAfterResize) {
  using M = Minco<TypeParam::D, TypeParam::S>;
  const test::Problem<TypeParam::D, TypeParam::S> problem(30, 1);
  std::vector<typename M::Piece> by_piece(30, M::Piece::Zero());
  Eigen::VectorXd by_duration = Eigen::VectorXd::Zero(30);
  typename M::Knots by_knot(TypeParam::D, 29);
  M minco;
  std::size_t before = allocations;
  minco.resize(30);
  EXPECT_GT(allocations, before);  // they are counted
  before = allocations;
  minco.solve(problem.start, problem.end, problem.knots, problem.durations);
  const double effort = minco.effort();
  minco.add_effort_gradient(1.0, by_piece, by_duration);
  minco.propagate(by_piece, by_duration, by_knot);
  EXPECT_EQ(allocations, before);
  EXPECT_GT(effort, 0.0);
}

}  // namespace
}  // namespace mocha
