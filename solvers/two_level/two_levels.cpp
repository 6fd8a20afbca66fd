#include "solvers/two_level/two_levels.hpp"

#include <Eigen/Cholesky>

namespace airybench {
namespace {

// Zero where held, the inverse elsewhere.
Eigen::Matrix4d inverse_on_free(const Eigen::Matrix4d& D, const std::array<bool, 4>& held) {
  Eigen::Matrix4d matrix = D, result;
  for (int i = 0; i < 4; ++i)
    if (held[i]) {
      matrix.row(i).setZero();
      matrix.col(i).setZero();
      matrix(i, i) = 1;
    }
  const Eigen::LLT<Eigen::Matrix4d> cholesky(matrix);
  if (cholesky.info() != Eigen::Success)
    throw Breakdown("two levels: an edge's stiffness is not positive definite");
  result = cholesky.solve(Eigen::Matrix4d::Identity());
  for (int i = 0; i < 4; ++i)
    if (held[i]) {
      result.row(i).setZero();
      result.col(i).setZero();
    }
  return result;
}

}  // namespace

TwoLevelPreconditioner::TwoLevelPreconditioner(const EdgeMatrix& K,
                                               std::unique_ptr<CoarseDisplacements> coarse)
    : K_(K), coarse_(std::move(coarse)), rest_(K.slots()) {
  inverse_.reserve(K.diagonal.size());
  for (const Eigen::Matrix4d& D : K.diagonal) inverse_.push_back(inverse_on_free(D, {}));
}

void TwoLevelPreconditioner::hold(const std::vector<Eigen::Index>& held) {
  std::map<int, std::array<bool, 4>> of_block;
  for (const Eigen::Index slot : held_) of_block[static_cast<int>(slot / 4)];
  for (const Eigen::Index slot : held) of_block[static_cast<int>(slot / 4)][slot % 4] = true;
  for (const auto& [block, own] : of_block)
    inverse_[block] = inverse_on_free(K_.diagonal[block], own);
  held_ = held;
  coarse_->hold(of_block);
}

void TwoLevelPreconditioner::relax(int i, const Eigen::VectorXd& r, Eigen::VectorXd& x) {
  const auto rows_of = [](int block) { return 4 * static_cast<Eigen::Index>(block); };
  Eigen::Vector4d load = r.segment<4>(rows_of(i));
  for (int k = K_.start[i]; k < K_.start[i + 1]; ++k)
    load.noalias() -= K_.left[k] * x.segment<4>(rows_of(K_.column[k]));
  const Eigen::Vector4d own = inverse_[i] * load;
  x.segment<4>(rows_of(i)) = own;
  for (int k = K_.start[i]; k < K_.start[i + 1]; ++k)
    rest_.segment<4>(rows_of(K_.column[k])).noalias() -= K_.left[k].transpose() * own;
}

void TwoLevelPreconditioner::sweep_forward(const Eigen::VectorXd& r, Eigen::VectorXd& x) {
  const SecondsInto timer(times_.smoother_s);
  x.resize(r.size());
  const auto relax_all = [&](int begin, int end) {
    const Eigen::Index first = 4 * static_cast<Eigen::Index>(begin);
    rest_.segment(first, 4 * static_cast<Eigen::Index>(end) - first).setZero();
    for (int i = begin; i < end; ++i) relax(i, r, x);
  };
  K_.visit_pieces(relax_all);
  relax_all(K_.piece.back(), K_.blocks());
}

void TwoLevelPreconditioner::sweep_backward(const Eigen::VectorXd& r, Eigen::VectorXd& x) {
  const SecondsInto timer(times_.smoother_s);
  rest_ = r;
  const auto relax_all = [&](int begin, int end) {
    for (int i = end; i-- > begin;) relax(i, rest_, x);
  };
  relax_all(K_.piece.back(), K_.blocks());
  K_.visit_pieces(relax_all);
}

void TwoLevelPreconditioner::apply(const Eigen::VectorXd& r, Eigen::VectorXd& x) {
  sweep_forward(r, x);
  {
    const SecondsInto timer(times_.coarse_s);
    coarse_->correct(rest_, x);
  }
  sweep_backward(r, x);
}

std::size_t TwoLevelPreconditioner::bytes() const {
  return coarse_->bytes() + inverse_.size() * sizeof(Eigen::Matrix4d) +
         held_.size() * sizeof(held_[0]) + static_cast<std::size_t>(rest_.size()) * sizeof(double);
}

}  // namespace airybench
