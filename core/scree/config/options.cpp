#include "scree/config/options.hpp"

#include <algorithm>
#include <stdexcept>

#include "scree/config/units.hpp"

namespace scree {

Options::Options() = default;
Options::~Options() = default;
Options::Options(Options&&) noexcept = default;
Options& Options::operator=(Options&&) noexcept = default;

Options::Options(const Options& other) : type_{other.type_}, location_{other.location_} {
  entries_.reserve(other.entries_.size());
  for (const auto& [name, entry] : other.entries_) entries_.emplace_back(name, std::make_unique<Entry>(*entry));
}

Options& Options::operator=(const Options& other) {
  if (this != &other) *this = Options{other};
  return *this;
}

const Options::Entry& Options::described(std::string_view name) const {
  const auto found = std::ranges::find_if(entries_, [&](const auto& entry) { return entry.first == name; });
  if (found == entries_.end()) throw std::logic_error{"setting '" + std::string{name} + "' was not described"};
  return *found->second;
}

const Options::Entry& Options::present(std::string_view name) const {
  const Entry& entry = described(name);
  if (!entry.present) throw std::logic_error{"setting '" + std::string{name} + "' has no value; ask has() first"};
  return entry;
}

template <class T>
const T& Options::value(std::string_view name, const char* kind) const {
  const T* typed = std::get_if<T>(&present(name).value);
  if (typed == nullptr) throw std::logic_error{"setting '" + std::string{name} + "' is no " + kind};
  return *typed;
}

bool Options::has(std::string_view name) const { return described(name).present; }
bool Options::given(std::string_view name) const {
  const Entry& entry = described(name);
  return entry.present && entry.given;
}

bool Options::boolean(std::string_view name) const { return value<bool>(name, "boolean"); }
std::int64_t Options::integer(std::string_view name) const { return value<std::int64_t>(name, "integer"); }
double Options::number(std::string_view name) const {
  if (const auto* whole = std::get_if<std::int64_t>(&present(name).value)) return static_cast<double>(*whole);
  return value<double>(name, "number");
}
double Options::number_in(std::string_view name, std::string_view unit) const {
  const Entry& entry = present(name);
  if (entry.written.empty()) return number(name);
  try {
    return parse_quantity(entry.written, unit);
  } catch (const Error& failure) {
    throw Error{failure.kind(), location(name), "'" + std::string{name} + "': " + failure.what()};
  }
}
Vec3 Options::vector(std::string_view name) const { return value<Vec3>(name, "vector"); }
const std::vector<double>& Options::numbers(std::string_view name) const {
  return value<std::vector<double>>(name, "list of numbers");
}
const std::string& Options::text(std::string_view name) const { return value<std::string>(name, "text"); }
const std::vector<std::string>& Options::texts(std::string_view name) const {
  return value<std::vector<std::string>>(name, "list of strings");
}

std::filesystem::path Options::path(std::string_view name) const {
  const std::filesystem::path written{text(name)};
  const std::filesystem::path& base = present(name).base;
  return std::filesystem::absolute(base.empty() ? written : base / written).lexically_normal();
}

const Options& Options::table(std::string_view name) const {
  const Entry& entry = present(name);
  if (entry.tables.size() != 1) throw std::logic_error{"setting '" + std::string{name} + "' is no table"};
  return entry.tables.front();
}

const std::vector<Options>& Options::tables(std::string_view name) const { return described(name).tables; }

std::vector<std::string> Options::names() const {
  std::vector<std::string> result;
  for (const auto& [name, entry] : entries_) {
    if (entry->present) result.push_back(name);
  }
  return result;
}

SourceLocation Options::location(std::string_view name) const {
  const Entry& entry = described(name);
  return entry.present && entry.given ? entry.where : location_;
}

Error Options::error(std::string_view name, const std::string& sentence) const {
  return Error{ErrorKind::usage, location(name), "'" + std::string{name} + "' " + sentence};
}
Error Options::error(const std::string& sentence) const { return Error{ErrorKind::usage, location_, sentence}; }

void Options::set(const std::string& name, Entry entry) {
  const auto found = std::ranges::find_if(entries_, [&](const auto& known) { return known.first == name; });
  if (found != entries_.end()) {
    *found->second = std::move(entry);
  } else {
    entries_.emplace_back(name, std::make_unique<Entry>(std::move(entry)));
  }
}

void Options::set(const std::string& name, Parameter::Value value) {
  Entry entry;
  entry.value = std::move(value);
  entry.where = location_;
  set(name, std::move(entry));
}

const Options::Entry* Options::find(std::string_view name) const {
  const auto found = std::ranges::find_if(entries_, [&](const auto& entry) { return entry.first == name; });
  return found == entries_.end() || !found->second->present ? nullptr : found->second.get();
}

}  // namespace scree
