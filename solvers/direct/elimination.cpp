#include "solvers/direct/elimination.hpp"

#include <cholmod.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <new>
#include <numeric>
#include <span>

namespace airybench {
namespace {

// Above so many operations METIS's time is worth a try.
constexpr double many_flops = 1e10;

// Rows of indices, one after the other.
struct Lists {
  std::vector<int> start, entry;
  std::span<const int> operator[](int i) const {
    return {entry.data() + start[i], entry.data() + start[i + 1]};
  }
};

Lists elements_of_unknowns(const ElementMatrices& K) {
  Lists lists;
  lists.start.assign(static_cast<std::size_t>(K.order) + 1, 0);
  for (const auto& unknowns : K.unknown)
    for (const int u : unknowns)
      if (u >= 0) ++lists.start[u + 1];
  std::partial_sum(lists.start.begin(), lists.start.end(), lists.start.begin());
  lists.entry.resize(static_cast<std::size_t>(lists.start.back()));
  std::vector<int> next(lists.start.begin(), lists.start.end() - 1);
  for (int e = 0; e < K.count(); ++e)
    for (const int u : K.unknown[e])
      if (u >= 0) lists.entry[next[u]++] = e;
  return lists;
}

// Neighbouring unknowns that the same elements have, on the same side of the trailing ones.
struct Blocks {
  std::vector<int> first;  // unknown of each block, and the end
  std::vector<int> of;     // of each unknown
  int inner = 0;           // blocks before the trailing ones
  int count() const { return static_cast<int>(first.size()) - 1; }
  int size(int block) const { return first[block + 1] - first[block]; }
};

Blocks find_blocks(const ElementMatrices& K, int trailing) {
  const Lists elements = elements_of_unknowns(K);
  Blocks blocks;
  blocks.of.resize(static_cast<std::size_t>(K.order));
  for (int u = 0; u < K.order; ++u) {
    if (u == K.order - trailing) blocks.inner = static_cast<int>(blocks.first.size());
    if (u == 0 || u == K.order - trailing || !std::ranges::equal(elements[u], elements[u - 1]))
      blocks.first.push_back(u);
    blocks.of[u] = static_cast<int>(blocks.first.size()) - 1;
  }
  if (trailing == 0) blocks.inner = static_cast<int>(blocks.first.size());
  blocks.first.push_back(K.order);
  return blocks;
}

// CHOLMOD with the pattern of the graph of blocks.
class Analysis {
 public:
  Analysis(const ElementMatrices& K, const Blocks& blocks) : n_(blocks.count()) {
    cholmod_start(&common_);
    common_.print = 0;
    common_.supernodal = CHOLMOD_SUPERNODAL;
    // Supernodes are merged up to so many columns if not more than this part of them is zeros:
    // CHOLMOD's own numbers, counted in blocks, which have four unknowns most often.
    common_.nrelax[0] = 1;
    common_.nrelax[1] = 4;
    common_.nrelax[2] = 12;
    std::vector<std::vector<int>> below(static_cast<std::size_t>(n_));
    std::vector<int> own;
    for (const auto& unknowns : K.unknown) {
      own.clear();
      for (const int u : unknowns)
        if (u >= 0) own.push_back(blocks.of[u]);
      std::ranges::sort(own);
      own.erase(std::unique(own.begin(), own.end()), own.end());
      for (std::size_t j = 0; j < own.size(); ++j)
        below[own[j]].insert(below[own[j]].end(), own.begin() + j, own.end());
    }
    start_.push_back(0);
    for (auto& rows : below) {
      std::ranges::sort(rows);
      rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
      row_.insert(row_.end(), rows.begin(), rows.end());
      start_.push_back(static_cast<int>(row_.size()));
    }
  }
  ~Analysis() { cholmod_finish(&common_); }
  Analysis(const Analysis&) = delete;
  Analysis& operator=(const Analysis&) = delete;

  using Factor = std::unique_ptr<cholmod_factor, std::function<void(cholmod_factor*)>>;

  // Orders of the first `blocks` of them.
  std::vector<int> by_minimum_degree(int blocks) {
    Leading leading = leading_part(blocks);
    std::vector<int> order(static_cast<std::size_t>(blocks));
    if (!cholmod_amd(&leading.matrix, nullptr, 0, order.data(), &common_)) throw std::bad_alloc();
    return order;
  }
  std::vector<int> by_nested_dissection(int blocks) {
    Leading leading = leading_part(blocks);
    common_.nmethods = 1;
    common_.method[0].ordering = CHOLMOD_METIS;
    common_.postorder = 1;
    common_.supernodal = CHOLMOD_SIMPLICIAL;  // only the order is wanted
    const Factor factor = owned(cholmod_analyze(&leading.matrix, &common_));
    common_.supernodal = CHOLMOD_SUPERNODAL;
    const auto* order = static_cast<const int*>(factor->Perm);
    return {order, order + blocks};
  }
  // Of all of them, in a given order.
  Factor given(std::vector<int> order) {
    common_.nmethods = 1;
    common_.method[0].ordering = CHOLMOD_GIVEN;
    common_.postorder = 0;  // it is one but for the trailing blocks, which must stay
    cholmod_sparse whole = pattern();
    return owned(cholmod_analyze_p(&whole, order.data(), nullptr, 0, &common_));
  }
  double flops() const { return common_.fl; }  // by the last order, a block for an unknown

 private:
  struct Leading {
    std::vector<int> start, row;
    cholmod_sparse matrix;
  };
  Leading leading_part(int blocks) {
    Leading leading;
    leading.matrix = pattern();
    if (blocks == n_) return leading;
    leading.start.push_back(0);
    for (int j = 0; j < blocks; ++j) {
      std::copy_if(row_.begin() + start_[j], row_.begin() + start_[j + 1],
                   std::back_inserter(leading.row), [&](int i) { return i < blocks; });
      leading.start.push_back(static_cast<int>(leading.row.size()));
    }
    leading.matrix.nrow = leading.matrix.ncol = static_cast<std::size_t>(blocks);
    leading.matrix.nzmax = leading.row.size();
    leading.matrix.p = leading.start.data();
    leading.matrix.i = leading.row.data();
    return leading;
  }
  cholmod_sparse pattern() {
    cholmod_sparse matrix{};
    matrix.nrow = matrix.ncol = static_cast<std::size_t>(n_);
    matrix.nzmax = row_.size();
    matrix.p = start_.data();
    matrix.i = row_.data();
    matrix.stype = -1;
    matrix.itype = CHOLMOD_INT;
    matrix.xtype = CHOLMOD_PATTERN;
    matrix.dtype = CHOLMOD_DOUBLE;
    matrix.sorted = matrix.packed = 1;
    return matrix;
  }
  Factor owned(cholmod_factor* factor) {
    if (factor == nullptr) throw std::bad_alloc();
    return {factor, [this](cholmod_factor* f) { cholmod_free_factor(&f, &common_); }};
  }
  cholmod_common common_;
  int n_;
  std::vector<int> start_, row_;  // the lower triangle by columns
};

// Blocks in the order of elimination, the trailing ones last.
std::vector<int> order_blocks(Analysis& analysis, const Blocks& blocks) {
  std::vector<int> order;
  if (blocks.inner > 0) {
    order = analysis.by_minimum_degree(blocks.inner);
    const double flops = analysis.flops();
    const double unknowns_per_block = static_cast<double>(blocks.first.back()) / blocks.count();
    if (flops * std::pow(unknowns_per_block, 3) > many_flops) {
      std::vector<int> other = analysis.by_nested_dissection(blocks.inner);
      if (analysis.flops() < flops) order = std::move(other);
    }
  }
  for (int block = blocks.inner; block < blocks.count(); ++block) order.push_back(block);
  return order;
}

// Places, pivots and rows of the fronts, from supernodes of blocks.
void expand(const cholmod_factor& supernodes, const Blocks& blocks, const std::vector<int>& order,
            Elimination& result) {
  const int n = blocks.count();
  std::vector<int> start(static_cast<std::size_t>(n) + 1, 0);  // place of each block in the order
  result.place.resize(static_cast<std::size_t>(blocks.first.back()));
  for (int k = 0; k < n; ++k) {
    const int block = order[k], size = blocks.size(block);
    for (int i = 0; i < size; ++i) result.place[blocks.first[block] + i] = start[k] + i;
    start[k + 1] = start[k] + size;
  }
  const auto* super = static_cast<const int*>(supernodes.super);
  const auto* rows_at = static_cast<const int*>(supernodes.pi);
  const auto* rows = static_cast<const int*>(supernodes.s);
  result.fronts.resize(supernodes.nsuper);
  for (std::size_t f = 0; f < supernodes.nsuper; ++f) {
    Front& front = result.fronts[f];
    front.first = start[super[f]];
    front.pivots = start[super[f + 1]] - front.first;
    front.rows_at = result.rows.size();
    for (int k = rows_at[f]; k < rows_at[f + 1]; ++k)
      for (int place = start[rows[k]]; place < start[rows[k] + 1]; ++place)
        result.rows.push_back(place);
    front.rows = static_cast<int>(result.rows.size() - front.rows_at);
    front.panel_at = result.panel_doubles;
    result.panel_doubles += static_cast<std::size_t>(front.rows) * front.pivots;
  }
}

// Of every place, the front that has it as a pivot.
std::vector<int> fronts_of_places(const Elimination& elimination) {
  std::vector<int> front_at(elimination.place.size());
  for (int f = 0; f < static_cast<int>(elimination.fronts.size()); ++f)
    std::fill_n(front_at.begin() + elimination.fronts[f].first, elimination.fronts[f].pivots, f);
  return front_at;
}

// The fronts' tree, its children so ordered that few updates wait at a time (Liu 1986,
// doi:10.1145/6497.6499): by how much more a child needs than it leaves.
void order_fronts(const std::vector<int>& front_at, Elimination& result) {
  const int count = static_cast<int>(result.fronts.size());
  std::vector<int> roots;
  for (int f = 0; f < count; ++f) {
    const Front& front = result.fronts[f];
    if (front.below() == 0)
      roots.push_back(f);
    else
      result.fronts[front_at[result.rows[front.rows_at + front.pivots]]].children.push_back(f);
  }
  // A child comes before its parent in the places, so its need is known.
  std::vector<std::size_t> need(static_cast<std::size_t>(count));
  for (int f = 0; f < count; ++f) {
    Front& front = result.fronts[f];
    const auto leaves = [&](int child) { return result.fronts[child].update_doubles(); };
    std::ranges::sort(front.children, std::greater{},
                      [&](int child) { return need[child] - leaves(child); });
    std::size_t waiting = 0;
    for (const int child : front.children) {
      need[f] = std::max(need[f], waiting + need[child]);
      waiting += leaves(child);
    }
    need[f] = std::max(need[f], waiting + leaves(f));
  }
  for (const int root : roots) result.update_doubles = std::max(result.update_doubles, need[root]);
  // Postorder, without recursion: chains of fronts are as long as the mesh.
  std::vector<std::pair<int, std::size_t>> path;
  for (const int root : roots) {
    path.emplace_back(root, 0);
    while (!path.empty()) {
      const int f = path.back().first;
      if (path.back().second < result.fronts[f].children.size()) {
        const int child = result.fronts[f].children[path.back().second++];
        path.emplace_back(child, 0);
      } else {
        result.order.push_back(f);
        path.pop_back();
      }
    }
  }
}

void hand_out_elements(const ElementMatrices& K, const std::vector<int>& front_at,
                       Elimination& result) {
  for (int e = 0; e < K.count(); ++e) {
    int first = K.order;
    for (const int u : K.unknown[e])
      if (u >= 0) first = std::min(first, result.place[u]);
    if (first < K.order) result.fronts[front_at[first]].elements.push_back(e);
  }
}

}  // namespace

std::int64_t Elimination::entries() const {
  std::int64_t sum = 0;
  for (const Front& front : fronts)
    sum += std::int64_t{front.pivots} * front.rows -
           std::int64_t{front.pivots} * (front.pivots - 1) / 2;
  return sum;
}

double Elimination::flops() const {
  double sum = 0;
  for (const Front& front : fronts)
    for (int k = 0; k < front.pivots; ++k) {
      const double height = front.rows - k;
      sum += height * height;
    }
  return sum;
}

Elimination analyse_elimination(const ElementMatrices& K, int trailing) {
  Elimination result;
  result.trailing = trailing;
  if (K.order == 0) return result;
  const Blocks blocks = find_blocks(K, trailing);
  Analysis analysis(K, blocks);
  const std::vector<int> order = order_blocks(analysis, blocks);
  expand(*analysis.given(order), blocks, order, result);
  const std::vector<int> front_at = fronts_of_places(result);
  order_fronts(front_at, result);
  hand_out_elements(K, front_at, result);
  return result;
}

}  // namespace airybench
