// Numbers computed apart from this library: the tables of tests/data, where each says how it was made.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace reference {

/// A number, a text, a list or a row of a table.
class Value {
 public:
  explicit Value(const nlohmann::json& json) : json_(&json) {}

  operator double() const;  ///< JSON has no infinity: null stands for it

  /// @tparam T  bool, int, std::string, or a vector of int or std::size_t
  template <class T>
  T as() const;
  std::vector<double> list() const;
  std::vector<Value> items() const;

  /// @throws std::exception  there is no such key
  Value operator[](const char* key) const;

  bool has(const char* key) const;
  double number(const char* key, double otherwise) const { return has(key) ? (*this)[key] : otherwise; }

 private:
  const nlohmann::json* json_;
};

/// The rows of a table in tests/data/<file>.json.
std::vector<Value> rows(const std::string& file, const char* table);

/// The row with this id.
Value row(const std::string& file, const char* table, const std::string& id);

/// The content of a file of the source, by its path in it.
std::string text_of(const std::string& path);

}  // namespace reference
