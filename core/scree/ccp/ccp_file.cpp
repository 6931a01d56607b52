#include "scree/ccp/ccp_file.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "scree/base/error.hpp"
#include "scree/base/require.hpp"
#include "scree/state/hdf5_checkpoint.hpp"

namespace scree {
namespace {

const StateContent kContent{"contact problem", "ccp_100.h5"};

// Directions of a file of other software may be rounded to single precision.
constexpr double kDirectionError = 1e-6;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

static_assert(sizeof(Mat3) == 9 * sizeof(double));

/// Says what does not fit, and where.
class Judgement {
 public:
  explicit Judgement(const std::string& place) : place_{place} {}

  void require(bool good, const std::string& sentence) const {
    if (!good) throw Error{ErrorKind::io, place_ + " cannot be used: " + sentence + "."};
  }
  void size(const char* name, std::size_t found, std::size_t wanted, const std::string& reason) const {
    require(found == wanted, "\"" + std::string{name} + "\" has " + std::to_string(found) + " entries instead of " +
                                 std::to_string(wanted) + ", " + reason);
  }
  void finite(const char* name, std::span<const double> values) const {
    every(
        name, values, [](double value) { return std::isfinite(value); }, "is not a finite number");
  }
  void not_negative(const char* name, std::span<const double> values) const {
    every(
        name, values, [](double value) { return value >= 0.0; }, "is negative");
  }

 private:
  template <class Good>
  void every(const char* name, std::span<const double> values, const Good& good, const char* what) const {
    const auto bad = std::find_if_not(values.begin(), values.end(), good);
    if (bad == values.end()) return;
    require(false, "entry " + std::to_string(bad - values.begin()) + " of \"" + name + "\" " + what);
  }
  const std::string& place_;
};

void check_bodies(const CcpRecord& record, const Judgement& judgement) {
  const std::size_t n = record.inverse_mass.size();
  judgement.size("inverse_inertia", record.inverse_inertia.size(), n, "one matrix a body");
  judgement.finite("inverse_mass", record.inverse_mass);
  judgement.not_negative("inverse_mass", record.inverse_mass);
  for (std::size_t k = 0; k < n; ++k) {
    const Mat3& j = record.inverse_inertia[k];
    const std::string body = "the inverse inertia of body " + std::to_string(k);
    judgement.require(is_finite(j.row0) && is_finite(j.row1) && is_finite(j.row2), body + " is not finite");
    const double trace = j.row0.x + j.row1.y + j.row2.z;
    const double skewness =
        std::max({std::abs(j.row0.y - j.row1.x), std::abs(j.row0.z - j.row2.x), std::abs(j.row1.z - j.row2.y)});
    judgement.require(std::min({j.row0.x, j.row1.y, j.row2.z}) >= 0.0, body + " has a negative diagonal");
    judgement.require(skewness <= kDirectionError * trace, body + " is not symmetric");
    judgement.require(record.inverse_mass[k] > 0.0 || trace == 0.0, body + " is not zero, but its inverse mass is");
  }
}

void check_contact(const CcpRecord& record, std::size_t i, const Judgement& judgement) {
  const CcpContact& c = record.contacts[i];
  const std::string contact = "contact " + std::to_string(i);
  const std::size_t n = record.inverse_mass.size();
  for (const std::uint32_t body : {c.a, c.b}) {
    judgement.require(body < n, contact + " is on body " + std::to_string(body) + ", but there are only " +
                                    std::to_string(n) + " bodies, counted from 0");
  }
  judgement.require(is_finite(c.normal) && is_finite(c.arm_a) && is_finite(c.arm_b) && std::isfinite(c.friction),
                    contact + " has a number that is not finite");
  judgement.require(c.friction >= 0.0, contact + " has a negative coefficient of friction");
  judgement.require(std::abs(norm(c.normal) - 1.0) <= kDirectionError,
                    contact + " has a normal that is not a unit vector");
}

/// Numbers of all blocks.
std::size_t rows_of(std::span<const CcpBlock> blocks) {
  std::size_t rows = 0;
  for (const CcpBlock& block : blocks) rows += block.rows;
  return rows;
}

bool has_a_cone(int rows) { return rows == 1 || rows == 2 || rows == 3 || rows == 5 || rows == 6; }

void check_blocks(const CcpRecord& record, const Judgement& judgement) {
  std::size_t row = 0;
  for (std::size_t i = 0; i < record.blocks.size(); ++i) {
    const CcpBlock& k = record.blocks[i];
    const std::string block = "block " + std::to_string(i);
    judgement.require(k.kind <= CcpKind::cone, block + " is of an unknown kind");
    judgement.require(k.rows >= 1 && k.rows <= CcpBlock::kMostRows && (k.kind != CcpKind::cone || has_a_cone(k.rows)),
                      block + " has " + std::to_string(k.rows) + " rows, which its kind does not have");
    judgement.require(k.first_row == row, block + " does not begin where the one before it ends");
    row += k.rows;
    judgement.require(record.block_rows.empty() || std::max(k.a, k.b) < record.inverse_mass.size(),
                      block + " names a body that is not there");
    judgement.require(k.friction >= 0.0 && k.spinning >= 0.0 && k.rolling >= 0.0 && std::isfinite(k.friction) &&
                          std::isfinite(k.spinning) && std::isfinite(k.rolling),
                      block + " has a coefficient of friction that is negative or not finite");
    judgement.require(k.kind != CcpKind::box || (k.lower <= k.upper && k.lower < kInfinity && k.upper > -kInfinity),
                      block + " has no number between its bounds");
  }
  for (std::size_t k = 0; k < record.block_rows.size(); ++k) {
    const CcpRow& j = record.block_rows[k];
    judgement.require(
        is_finite(j.a.linear) && is_finite(j.a.angular) && is_finite(j.b.linear) && is_finite(j.b.angular),
        "row " + std::to_string(k) + " of the blocks has a number that is not finite");
  }
}

/// One member of every block, or of every row of them.
template <class Value, class Item, class Get>
std::vector<Value> gather(const std::vector<Item>& items, const Get& get) {
  std::vector<Value> values;
  values.reserve(items.size());
  for (const Item& item : items) values.push_back(static_cast<Value>(get(item)));
  return values;
}

void write_blocks(StateWriter& out, const CcpRecord& record) {
  if (record.blocks.empty()) return;
  const auto integers = [&](const char* name, const auto& get) {
    out.write(name, gather<std::uint64_t>(record.blocks, get));
  };
  const auto doubles = [&](const char* name, double CcpBlock::*member) {
    out.write(name, gather<double>(record.blocks, [member](const CcpBlock& b) { return b.*member; }));
  };
  integers("block_kind", [](const CcpBlock& b) { return b.kind; });
  integers("block_size", [](const CcpBlock& b) { return b.rows; });
  integers("block_a", [](const CcpBlock& b) { return b.a; });
  integers("block_b", [](const CcpBlock& b) { return b.b; });
  doubles("block_friction", &CcpBlock::friction);
  doubles("block_spinning", &CcpBlock::spinning);
  doubles("block_rolling", &CcpBlock::rolling);
  doubles("block_lower", &CcpBlock::lower);
  doubles("block_upper", &CcpBlock::upper);
  const auto twists = [&](const char* name, Twist CcpRow::*member) {
    std::vector<double> flat;
    for (const CcpRow& row : record.block_rows) {
      const Twist& t = row.*member;
      flat.insert(flat.end(), {t.linear.x, t.linear.y, t.linear.z, t.angular.x, t.angular.y, t.angular.z});
    }
    out.write(name, flat);
  };
  twists("block_row_a", &CcpRow::a);
  twists("block_row_b", &CcpRow::b);
}

void read_blocks(const StateReader& in, CcpRecord& record, const Judgement& judgement) {
  if (!in.has("block_kind")) return;
  const std::vector<std::uint64_t> kinds = in.integers("block_kind");
  record.blocks.resize(kinds.size());
  const auto integers = [&](const char* name, std::uint64_t greatest, const auto& set) {
    const std::vector<std::uint64_t> values = in.integers(name);
    judgement.size(name, values.size(), kinds.size(), "one a block");
    for (std::size_t i = 0; i < values.size(); ++i) set(record.blocks[i], std::min(values[i], greatest));
  };
  const auto doubles = [&](const char* name, double CcpBlock::*member) {
    const std::vector<double> values = in.doubles(name);
    judgement.size(name, values.size(), kinds.size(), "one a block");
    for (std::size_t i = 0; i < values.size(); ++i) record.blocks[i].*member = values[i];
  };
  constexpr std::uint64_t kGreatest = std::numeric_limits<std::uint32_t>::max(), kByte = 255;
  integers("block_kind", kByte, [](CcpBlock& b, std::uint64_t value) { b.kind = static_cast<CcpKind>(value); });
  integers("block_size", kByte, [](CcpBlock& b, std::uint64_t value) { b.rows = static_cast<std::uint8_t>(value); });
  integers("block_a", kGreatest, [](CcpBlock& b, std::uint64_t value) { b.a = static_cast<std::uint32_t>(value); });
  integers("block_b", kGreatest, [](CcpBlock& b, std::uint64_t value) { b.b = static_cast<std::uint32_t>(value); });
  doubles("block_friction", &CcpBlock::friction);
  doubles("block_spinning", &CcpBlock::spinning);
  doubles("block_rolling", &CcpBlock::rolling);
  doubles("block_lower", &CcpBlock::lower);
  doubles("block_upper", &CcpBlock::upper);
  std::uint32_t row = 0;
  for (CcpBlock& block : record.blocks) {
    block.first_row = row;
    row += block.rows;
  }
  record.block_rows.resize(row);
  const auto twists = [&](const char* name, Twist CcpRow::*member) {
    const std::vector<double> flat = in.doubles(name);
    judgement.size(name, flat.size(), 6 * record.block_rows.size(), "six a row of a block");
    for (std::size_t k = 0; k < record.block_rows.size(); ++k) {
      const double* t = flat.data() + 6 * k;
      record.block_rows[k].*member = {{t[0], t[1], t[2]}, {t[3], t[4], t[5]}};
    }
  };
  twists("block_row_a", &CcpRow::a);
  twists("block_row_b", &CcpRow::b);
}

/// One member of every contact.
std::vector<Vec3> column(const CcpRecord& record, Vec3 CcpContact::*member) {
  std::vector<Vec3> values;
  values.reserve(record.contacts.size());
  for (const CcpContact& c : record.contacts) values.push_back(c.*member);
  return values;
}
std::vector<std::uint64_t> column(const CcpRecord& record, std::uint32_t CcpContact::*member) {
  std::vector<std::uint64_t> values;
  values.reserve(record.contacts.size());
  for (const CcpContact& c : record.contacts) values.push_back(c.*member);
  return values;
}

/// Reads the columns of the contacts, all of one length.
std::vector<CcpContact> read_contacts(const StateReader& in, const Judgement& judgement) {
  const std::vector<double> friction = in.doubles("friction");
  std::vector<CcpContact> contacts(friction.size());
  for (std::size_t i = 0; i < contacts.size(); ++i) contacts[i].friction = friction[i];
  const auto vectors = [&](const char* name, Vec3 CcpContact::*member) {
    const std::vector<double> flat = in.doubles(name);
    judgement.size(name, flat.size(), 3 * contacts.size(), "three a contact");
    for (std::size_t i = 0; i < contacts.size(); ++i) {
      contacts[i].*member = {flat[3 * i], flat[3 * i + 1], flat[3 * i + 2]};
    }
  };
  const auto indices = [&](const char* name, std::uint32_t CcpContact::*member) {
    const std::vector<std::uint64_t> values = in.integers(name);
    judgement.size(name, values.size(), contacts.size(), "one a contact");
    for (std::size_t i = 0; i < contacts.size(); ++i) {
      constexpr std::uint64_t kGreatest = std::numeric_limits<std::uint32_t>::max();
      contacts[i].*member = static_cast<std::uint32_t>(std::min(values[i], kGreatest));
    }
  };
  vectors("normal", &CcpContact::normal);
  vectors("arm_a", &CcpContact::arm_a);
  vectors("arm_b", &CcpContact::arm_b);
  indices("body_a", &CcpContact::a);
  indices("body_b", &CcpContact::b);
  return contacts;
}

std::vector<Mat3> read_inertias(const StateReader& in, std::size_t bodies, const Judgement& judgement) {
  const std::vector<double> flat = in.doubles("inverse_inertia");
  judgement.size("inverse_inertia", flat.size(), 9 * bodies, "nine a body");
  std::vector<Mat3> values(bodies);
  for (std::size_t k = 0; k < bodies; ++k) {
    const double* j = flat.data() + 9 * k;
    values[k] = {{j[0], j[1], j[2]}, {j[3], j[4], j[5]}, {j[6], j[7], j[8]}};
  }
  return values;
}

}  // namespace

CcpRecord make_ccp_record(const CcpProblem& problem, std::span<const double> guess, CcpOrigin origin) {
  return {{problem.inverse_mass.begin(), problem.inverse_mass.end()},
          {problem.inverse_inertia.begin(), problem.inverse_inertia.end()},
          {problem.contacts.begin(), problem.contacts.end()},
          {problem.r.begin(), problem.r.end()},
          {problem.compliance.begin(), problem.compliance.end()},
          {guess.begin(), guess.end()},
          std::move(origin),
          {problem.blocks.begin(), problem.blocks.end()},
          {problem.block_rows.begin(), problem.block_rows.end()},
          {}};
}

void check_ccp_record(const CcpRecord& record, const std::string& place) {
  const Judgement judgement{place};
  const std::size_t rows = 3 * record.contacts.size() + rows_of(record.blocks);
  const std::string each = record.blocks.empty() ? "three a contact" : "one a row";
  check_bodies(record, judgement);
  judgement.size("r", record.r.size(), rows, each);
  judgement.size("guess", record.guess.size(), rows, each);
  if (!record.compliance.empty()) {
    judgement.size("compliance", record.compliance.size(), rows, each + " or none at all");
  }
  check_blocks(record, judgement);
  for (std::size_t i = 0; i < record.contacts.size(); ++i) check_contact(record, i, judgement);
  judgement.finite("r", record.r);
  judgement.finite("guess", record.guess);
  judgement.finite("compliance", record.compliance);
  judgement.not_negative("compliance", record.compliance);
  judgement.require(std::isfinite(record.origin.tolerance) && record.origin.tolerance >= 0.0,
                    "\"tolerance\" is not a number from 0 on");
  judgement.require(record.origin.max_iterations >= 1, "\"max_iterations\" is not a number from 1 on");
}

void write_ccp_file(const std::filesystem::path& file, const CcpRecord& record) {
  SCREE_REQUIRE(record.matrix.first.empty(), "write_ccp_file: a problem with a matrix is kept as an FCLIB file");
  CheckpointWriter writer{{record.origin.scene_hash, record.origin.scree_version}, kContent};
  StateWriter& out = writer.root();
  std::vector<double> friction;
  for (const CcpContact& c : record.contacts) friction.push_back(c.friction);
  out.write("inverse_mass", record.inverse_mass);
  out.write("inverse_inertia", std::span{reinterpret_cast<const double*>(record.inverse_inertia.data()),
                                         9 * record.inverse_inertia.size()});
  out.write("normal", column(record, &CcpContact::normal));
  out.write("arm_a", column(record, &CcpContact::arm_a));
  out.write("arm_b", column(record, &CcpContact::arm_b));
  out.write("friction", friction);
  out.write("body_a", column(record, &CcpContact::a));
  out.write("body_b", column(record, &CcpContact::b));
  out.write("r", record.r);
  out.write("compliance", record.compliance);
  out.write("guess", record.guess);
  out.write("time", record.origin.time);
  out.write("step", record.origin.step);
  out.write("tolerance", record.origin.tolerance);
  out.write("max_iterations", static_cast<std::uint64_t>(record.origin.max_iterations));
  write_blocks(out, record);
  writer.save_as(file);
}

CcpRecord read_ccp_file(const std::filesystem::path& file) {
  const CheckpointReader reader{file, kContent};
  const StateReader& in = reader.root();
  const std::string place = "the contact problem " + file.string();
  const Judgement judgement{place};
  CcpRecord record;
  record.inverse_mass = in.doubles("inverse_mass");
  record.inverse_inertia = read_inertias(in, record.inverse_mass.size(), judgement);
  record.contacts = read_contacts(in, judgement);
  record.r = in.doubles("r");
  record.compliance = in.doubles("compliance");
  record.guess = in.doubles("guess");
  read_blocks(in, record, judgement);
  constexpr std::uint64_t kGreatest = std::numeric_limits<int>::max();
  record.origin = {reader.header().scene_hash, reader.header().scree_version,
                   in.number("time"),          in.integer("step"),
                   in.number("tolerance"),     static_cast<int>(std::min(in.integer("max_iterations"), kGreatest))};
  check_ccp_record(record, place);
  return record;
}

}  // namespace scree
