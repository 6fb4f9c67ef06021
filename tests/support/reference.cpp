#include "support/reference.hpp"

#include <cstddef>
#include <fstream>
#include <iterator>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace reference {

Value::operator double() const {
  return json_->is_null() ? std::numeric_limits<double>::infinity() : json_->get<double>();
}

template <class T>
T Value::as() const {
  return json_->get<T>();
}
template bool Value::as() const;
template int Value::as() const;
template std::string Value::as() const;
template std::vector<int> Value::as() const;
template std::vector<std::size_t> Value::as() const;

std::vector<double> Value::list() const {
  const std::vector<Value> values = items();
  return {values.begin(), values.end()};
}

std::vector<Value> Value::items() const { return {json_->begin(), json_->end()}; }

Value Value::operator[](const char* key) const { return Value(json_->at(key)); }

bool Value::has(const char* key) const { return json_->contains(key); }

std::vector<Value> rows(const std::string& file, const char* table) {
  static std::map<std::string, nlohmann::json> files;
  nlohmann::json& json = files[file];
  if (json.is_null()) json = nlohmann::json::parse(text_of("tests/data/" + file + ".json"));
  return Value(json)[table]["rows"].items();
}

Value row(const std::string& file, const char* table, const std::string& id) {
  for (const Value& row : rows(file, table))
    if (row["id"].as<std::string>() == id) return row;
  throw std::out_of_range(file + ".json, " + table + ": no row " + id);
}

std::string text_of(const std::string& path) {
  std::ifstream stream(STICKSLIP_SOURCE "/" + path, std::ios::binary);
  if (!stream) throw std::runtime_error("cannot read " + path);
  return {std::istreambuf_iterator<char>(stream), {}};
}

}  // namespace reference
