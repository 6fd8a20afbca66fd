#include "solvers/direct/elimination.hpp"

#include <cholmod.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <new>
#include <numeric>

#include "solvers/direct/dissection.hpp"

namespace airybench {
namespace {

// Minimum degree alone is faster, and as good, on fewer.
constexpr int many_elements = 30000;

IndexLists elements_of_unknowns(const ElementMatrices& K) {
  return gather_lists(K.order, [&](auto add) {
    for (int e = 0; e < K.count(); ++e)
      for (const int u : K.unknown[e])
        if (u >= 0) add(u, e);
  });
}

// Neighbouring unknowns that the same elements have, on the same side of the trailing ones.
struct UnknownBlocks {
  std::vector<int> first;  // unknown of each block, and the end
  std::vector<int> of;     // of each unknown
  int inner = 0;           // blocks before the trailing ones
  int count() const { return static_cast<int>(first.size()) - 1; }
  int size(int block) const { return first[block + 1] - first[block]; }
};

UnknownBlocks find_blocks(const ElementMatrices& K, int trailing) {
  const IndexLists elements = elements_of_unknowns(K);
  UnknownBlocks blocks;
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

// The blocks of each element, ascending.
IndexLists blocks_of_elements(const ElementMatrices& K, const UnknownBlocks& blocks) {
  IndexLists lists;
  lists.start.reserve(K.unknown.size() + 1);
  lists.entry.reserve(4 * K.unknown.size());
  std::vector<int> own(static_cast<std::size_t>(K.size));
  for (int e = 0; e < K.count(); ++e) {
    auto end = own.begin();
    for (const int u : K.unknown[e])
      if (u >= 0) *end++ = blocks.of[u];
    std::sort(own.begin(), end);
    lists.entry.insert(lists.entry.end(), own.begin(), std::unique(own.begin(), end));
    lists.end_list();
  }
  return lists;
}

// CHOLMOD with the pattern of the graph of blocks.
class Analysis {
 public:
  // own: the blocks of each element.
  Analysis(const IndexLists& own, int blocks) : n_(blocks) {
    cholmod_start(&common_);
    common_.print = 0;
    common_.supernodal = CHOLMOD_SUPERNODAL;
    // Supernodes are merged up to so many columns if not more than this part of them is zeros:
    // CHOLMOD's own numbers, counted in blocks, which have four unknowns most often.
    common_.nrelax[0] = 1;
    common_.nrelax[1] = 4;
    common_.nrelax[2] = 12;
    IndexLists below = gather_lists(n_, [&](auto add) {
      for (int e = 0; e < own.count(); ++e)
        for (std::size_t j = 0; j < own[e].size(); ++j)
          for (const int i : own[e].subspan(j)) add(own[e][j], i);
    });
    start_.reserve(below.start.size());
    row_.reserve(below.entry.size());
    start_.push_back(0);
    for (int j = 0; j < n_; ++j) {
      const std::span<int> rows = below[j];
      std::sort(rows.begin(), rows.end());
      row_.insert(row_.end(), rows.begin(), std::unique(rows.begin(), rows.end()));
      start_.push_back(static_cast<int>(row_.size()));
    }
  }
  ~Analysis() { cholmod_finish(&common_); }
  Analysis(const Analysis&) = delete;
  Analysis& operator=(const Analysis&) = delete;

  using Factor = std::unique_ptr<cholmod_factor, std::function<void(cholmod_factor*)>>;

  // Minimum degree, each stage after those before.
  std::vector<int> by_minimum_degree(std::vector<int> stage) {
    cholmod_sparse whole = pattern();
    std::vector<int> order(static_cast<std::size_t>(n_));
    if (!cholmod_camd(&whole, nullptr, 0, stage.data(), order.data(), &common_))
      throw std::bad_alloc();
    return order;
  }
  // Of all of them, in a given order.
  Factor given(std::vector<int> order) {
    common_.nmethods = 1;
    common_.method[0].ordering = CHOLMOD_GIVEN;
    common_.postorder = 0;  // it is one but for the trailing blocks, which must stay
    cholmod_sparse whole = pattern();
    return owned(cholmod_analyze_p(&whole, order.data(), nullptr, 0, &common_));
  }

 private:
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

// When each block is to be eliminated; the trailing ones last.
std::vector<int> stages(const ElementMatrices& K, const IndexLists& own,
                        const UnknownBlocks& blocks) {
  std::vector<int> stage(static_cast<std::size_t>(blocks.count()), 0);
  if (K.count() > many_elements) stage = dissect(blocks.count(), own, K.centre);
  if (blocks.inner > 0 && blocks.inner < blocks.count()) {
    const int last = *std::ranges::max_element(stage) + 1;
    std::fill(stage.begin() + blocks.inner, stage.end(), last);
  }
  return stage;
}

// Places, pivots and rows of the fronts, from supernodes of blocks.
void expand(const cholmod_factor& supernodes, const UnknownBlocks& blocks,
            const std::vector<int>& order, Elimination& result) {
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
  std::size_t count = 0;
  for (int k = 0; k < rows_at[supernodes.nsuper]; ++k) count += blocks.size(order[rows[k]]);
  result.rows.reserve(count);
  for (std::size_t f = 0; f < supernodes.nsuper; ++f) {
    Front& front = result.fronts[f];
    front.first = start[super[f]];
    front.pivots = start[super[f + 1]] - front.first;
    front.rows_at = result.rows.size();
    for (int k = rows_at[f]; k < rows_at[f + 1]; ++k)
      for (int place = start[rows[k]]; place < start[rows[k] + 1]; ++place)
        result.rows.push_back(place);
    front.rows = static_cast<int>(result.rows.size() - front.rows_at);
    front.panel_at = result.panel_entries;
    result.max_rows = std::max(result.max_rows, front.rows);
    result.panel_entries += static_cast<std::size_t>(front.rows) * front.pivots;
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
// doi:10.1145/7921.11325): by how much more a child needs than it leaves.
void order_fronts(const std::vector<int>& front_at, Elimination& result) {
  const int count = static_cast<int>(result.fronts.size());
  std::vector<int> roots;
  for (int f = 0; f < count; ++f)
    if (result.fronts[f].below() == 0) roots.push_back(f);
  result.children = gather_lists(count, [&](auto add) {
    for (int f = 0; f < count; ++f)
      if (const Front& front = result.fronts[f]; front.below() > 0)
        add(front_at[result.rows[front.rows_at + front.pivots]], f);
  });
  // A child comes before its parent in the places, so its need is known.
  std::vector<std::size_t> need(static_cast<std::size_t>(count));
  for (int f = 0; f < count; ++f) {
    const std::span<int> children = result.children[f];
    const auto leaves = [&](int child) { return result.fronts[child].update_doubles(); };
    std::ranges::sort(children, std::greater{},
                      [&](int child) { return need[child] - leaves(child); });
    std::size_t waiting = 0;
    for (const int child : children) {
      need[f] = std::max(need[f], waiting + need[child]);
      waiting += leaves(child);
    }
    need[f] = std::max(need[f], waiting + leaves(f));
  }
  for (const int root : roots) result.update_doubles = std::max(result.update_doubles, need[root]);
  // Postorder, without recursion: chains of fronts are as long as the mesh.
  std::vector<std::pair<int, std::size_t>> path;
  path.reserve(result.fronts.size());
  result.order.reserve(result.fronts.size());
  for (const int root : roots) {
    path.emplace_back(root, 0);
    while (!path.empty()) {
      const int f = path.back().first;
      if (path.back().second < result.children[f].size()) {
        const int child = result.children[f][path.back().second++];
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
  const auto count = static_cast<int>(result.fronts.size());
  result.elements = gather_lists(count, [&](auto add) {
    for (int e = 0; e < K.count(); ++e) {
      int first = K.order;
      for (const int u : K.unknown[e])
        if (u >= 0) first = std::min(first, result.place[u]);
      if (first < K.order) add(front_at[first], e);
    }
  });
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
  const UnknownBlocks blocks = find_blocks(K, trailing);
  const IndexLists own = blocks_of_elements(K, blocks);
  Analysis analysis(own, blocks.count());
  std::vector<int> order = analysis.by_minimum_degree(stages(K, own, blocks));
  std::iota(order.begin() + blocks.inner, order.end(), blocks.inner);
  expand(*analysis.given(order), blocks, order, result);
  const std::vector<int> front_at = fronts_of_places(result);
  order_fronts(front_at, result);
  hand_out_elements(K, front_at, result);
  return result;
}

}  // namespace airybench
