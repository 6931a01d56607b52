#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "scree/ccp/fclib/detail/fclib_matrix_io.hpp"

namespace scree {

namespace {

constexpr std::int64_t kColumns = -1, kRows = -2;  // values of nz that mean a packed matrix

/// A matrix as it stands in the file.
struct Stored {
  std::int64_t m, n, nz, nzmax;
  std::vector<std::int64_t> p, i;
  std::vector<double> x;
};

/// The first of the first `count` numbers that is not in 0 .. below - 1; `count` when there is none.
std::size_t first_outside(const std::vector<std::int64_t>& values, std::size_t count, std::int64_t below) {
  const auto end = values.begin() + static_cast<std::ptrdiff_t>(count);
  const auto bad =
      std::find_if(values.begin(), end, [below](std::int64_t value) { return value < 0 || value >= below; });
  return static_cast<std::size_t>(bad - values.begin());
}

void require_inside(const FclibGroupReader& in, const char* name, const std::vector<std::int64_t>& values,
                    std::size_t count, std::int64_t below, const char* what) {
  const std::size_t bad = first_outside(values, count, below);
  if (bad == count) return;
  in.place().inside(name).fail(
      fmt::format("has {} at entry {}; the matrix has {} {}, counted from 0", values[bad], bad, below, what));
}

/// `count` numbers at least have to stand in `name`.
void require_length(const FclibGroupReader& in, const char* name, std::size_t length, std::size_t count) {
  in.place().inside(name).require(length >= count,
                                  fmt::format("has {} numbers; the matrix has {} entries", length, count));
}

Stored read_stored(const FclibGroupReader& in) {
  Stored s{in.integer("m", 0), in.integer("n", 0), in.integer("nz"), in.integer("nzmax", 0),
           in.integers("p"),   in.integers("i"),   in.doubles("x")};
  in.place().inside("nz").require(
      s.nz >= kRows && s.nz <= std::numeric_limits<std::int32_t>::max(),
      fmt::format("is {}; valid are the number of entries of an unpacked matrix, {} for one "
                  "packed by columns and {} by rows",
                  s.nz, kColumns, kRows));
  return s;
}

void add(FclibMatrix& matrix, std::int64_t row, std::int64_t column, double value) {
  matrix.entries.push_back({static_cast<std::uint32_t>(row), static_cast<std::uint32_t>(column), value});
}

void read_triplets(const FclibGroupReader& in, const Stored& s, FclibMatrix& matrix) {
  const auto count = static_cast<std::size_t>(s.nz);
  require_length(in, "p", s.p.size(), count);
  require_length(in, "i", s.i.size(), count);
  require_length(in, "x", s.x.size(), count);
  const auto fits = [count](const std::vector<std::int64_t>& values, std::int64_t below) {
    return first_outside(values, count, below) == count;
  };
  // Rows are i; only where that cannot be are they p.
  const bool swapped = !(fits(s.i, s.m) && fits(s.p, s.n)) && fits(s.p, s.m) && fits(s.i, s.n);
  if (!swapped) {
    require_inside(in, "i", s.i, count, s.m, "rows");
    require_inside(in, "p", s.p, count, s.n, "columns");
  }
  for (std::size_t k = 0; k < count; ++k) {
    add(matrix, swapped ? s.p[k] : s.i[k], swapped ? s.i[k] : s.p[k], s.x[k]);
  }
}

void read_packed(const FclibGroupReader& in, const Stored& s, FclibMatrix& matrix) {
  const bool by_rows = s.nz == kRows;
  const std::int64_t lines = by_rows ? s.m : s.n;
  const FclibPlace at_p = in.place().inside("p");
  at_p.require(std::cmp_equal(s.p.size(), lines + 1),
               fmt::format("has {} numbers; {} are needed, one more than the matrix has {}", s.p.size(), lines + 1,
                           by_rows ? "rows" : "columns"));
  at_p.require(s.p.front() == 0 && std::is_sorted(s.p.begin(), s.p.end()),
               "does not ascend from 0, as the beginnings of rows or columns do");
  const std::int64_t end = s.p.back();
  at_p.require(end <= std::numeric_limits<std::int32_t>::max(), fmt::format("ends with {}, which is too many", end));
  const auto count = static_cast<std::size_t>(end);
  require_length(in, "i", s.i.size(), count);
  require_length(in, "x", s.x.size(), count);
  require_inside(in, "i", s.i, count, by_rows ? s.n : s.m, by_rows ? "columns" : "rows");
  for (std::int64_t line = 0; line < lines; ++line) {
    for (auto k = static_cast<std::size_t>(s.p[static_cast<std::size_t>(line)]);
         std::cmp_less(k, s.p[static_cast<std::size_t>(line) + 1]); ++k) {
      add(matrix, by_rows ? line : s.i[k], by_rows ? s.i[k] : line, s.x[k]);
    }
  }
}

/// The entries by rows or columns, without two at the same place.
std::vector<MatrixEntry> packed(const FclibMatrix& matrix, bool by_rows) {
  std::vector<MatrixEntry> entries = matrix.entries;
  const auto place = [by_rows](const MatrixEntry& e) {
    return by_rows ? std::pair{e.row, e.column} : std::pair{e.column, e.row};
  };
  std::stable_sort(entries.begin(), entries.end(),
                   [&](const MatrixEntry& a, const MatrixEntry& b) { return place(a) < place(b); });
  std::size_t kept = 0;
  for (const MatrixEntry& e : entries) {
    if (kept > 0 && place(entries[kept - 1]) == place(e)) {
      entries[kept - 1].value += e.value;
    } else {
      entries[kept++] = e;
    }
  }
  entries.resize(kept);
  return entries;
}

int narrow(const FclibGroupWriter& out, std::size_t value) {
  out.place().require(value <= static_cast<std::size_t>(std::numeric_limits<int>::max()),
                      fmt::format("would need the number {}, which FCLIB cannot keep", value));
  return static_cast<int>(value);
}

}  // namespace

FclibMatrix read_fclib_matrix(const FclibGroupReader& in) {
  const Stored stored = read_stored(in);
  FclibMatrix matrix{.rows = static_cast<std::size_t>(stored.m), .columns = static_cast<std::size_t>(stored.n)};
  if (stored.nz >= 0) {
    read_triplets(in, stored, matrix);
  } else {
    matrix.storage = stored.nz == kRows ? FclibStorage::rows : FclibStorage::columns;
    read_packed(in, stored, matrix);
  }
  if (in.has("conditioning")) {
    matrix.info = {in.text("comment"), in.doubles("conditioning", 1, "matrix").front(),
                   in.doubles("determinant", 1, "matrix").front(), static_cast<int>(in.integer("rank", 0))};
  }
  return matrix;
}

void write_fclib_matrix(const FclibGroupWriter& out, const FclibMatrix& matrix) {
  const bool triplets = matrix.storage == FclibStorage::triplets;
  const bool by_rows = matrix.storage == FclibStorage::rows;
  const std::vector<MatrixEntry> entries = triplets ? matrix.entries : packed(matrix, by_rows);
  std::vector<int> p, i;
  std::vector<double> x;
  for (const MatrixEntry& e : entries) {
    i.push_back(narrow(out, by_rows ? e.column : e.row));
    x.push_back(e.value);
    if (triplets) p.push_back(narrow(out, e.column));
  }
  if (!triplets) {
    p.assign((by_rows ? matrix.rows : matrix.columns) + 1, 0);
    for (const MatrixEntry& e : entries) ++p[(by_rows ? e.row : e.column) + 1];
    for (std::size_t k = 1; k < p.size(); ++k) p[k] += p[k - 1];
  }
  const int count = narrow(out, entries.size());
  out.write("nzmax", count);
  out.write("m", narrow(out, matrix.rows));
  out.write("n", narrow(out, matrix.columns));
  out.write("nz", triplets ? count : static_cast<int>(by_rows ? kRows : kColumns));
  out.write("p", std::span<const int>{p});
  out.write("i", std::span<const int>{i});
  out.write("x", std::span<const double>{x});
  if (!matrix.info) return;
  out.write("comment", matrix.info->comment);
  out.write("conditioning", matrix.info->conditioning);
  out.write("determinant", matrix.info->determinant);
  out.write("rank", matrix.info->rank);
}

}  // namespace scree
