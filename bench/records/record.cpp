#include "bench/records/record.hpp"

#include <fmt/format.h>

#include "bench/records/context.hpp"
#include "support/shortened.hpp"

namespace airybench {
namespace {

[[noreturn]] void fail_as_no_json(const Json::exception& wrong, const std::string& place) {
  throw RecordError(fmt::format("{}: not JSON: {}", place, without_prefix(wrong)));
}

[[noreturn]] void fail_as_no_object(const Json& json, const std::string& place) {
  throw RecordError(
      fmt::format("{}: {} (allowed: a JSON object)", place, shortened(json_text(json))));
}

// Records have them since version 3.
std::string points_of_older(const std::string& study) {
  return study == "error"     ? "accuracy"
         : study == "scaling" ? "threads"
         : study == "contact" ? study
                              : "";
}

class RecordBuilder {
 public:
  explicit RecordBuilder(const std::string& place)
      : place_(place), is_given_(record_fields().size()) {}

  void give(const std::string& key, const Json& value) {
    const Field* field = find_field(key);
    if (field == nullptr) return;
    const auto index = static_cast<std::size_t>(field - record_fields().data());
    if (is_given_[index]) field->clear(record_);  // the last of repeated keys counts
    is_given_[index] = true;
    field->read(value, place_, field->name, record_);
  }

  Record finish() {
    for (std::size_t i = 0; i < is_given_.size(); ++i)
      if (!is_given_[i]) give(record_fields()[i].name, Json());
    if (record_.general_name.empty()) record_.general_name = record_.method;
    if (record_.points.empty()) record_.points = points_of_older(record_.study);
    if (record_.family.empty())
      record_.family = record_.general_name.substr(0, record_.general_name.find(':'));
    if (record_.case_name.empty()) record_.case_name = name_of(record_).text();
    return std::move(record_);
  }

  const std::string& place() const { return place_; }

 private:
  const std::string& place_;
  std::vector<bool> is_given_;
  Record record_;
};

// Passes each top-level value to the builder and never holds the whole record's JSON.
class RecordParser : public Json::json_sax_t {
 public:
  explicit RecordParser(RecordBuilder& builder) : builder_(builder) {}

  bool null() override { return add(Json()); }
  bool boolean(bool value) override { return add(value); }
  bool number_integer(number_integer_t value) override { return add(value); }
  bool number_unsigned(number_unsigned_t value) override { return add(value); }
  bool number_float(number_float_t value, const string_t&) override { return add(value); }
  bool string(string_t& value) override { return add(std::move(value)); }
  bool binary(binary_t& value) override { return add(std::move(value)); }
  bool start_object(std::size_t) override {
    if (in_record_ || !open_.empty()) return open(Json::object());
    return in_record_ = true;
  }
  bool start_array(std::size_t) override { return open(Json::array()); }
  bool key(string_t& text) override {
    (open_.empty() ? record_key_ : key_).swap(text);
    return true;
  }
  bool end_object() override { return open_.empty() || close(); }
  bool end_array() override { return close(); }
  bool parse_error(std::size_t, const std::string&, const Json::exception& wrong) override {
    fail_as_no_json(wrong, builder_.place());
  }

 private:
  bool add(Json value) {
    put(std::move(value));
    return give_if_complete();
  }
  bool open(Json value) {
    open_.push_back(&put(std::move(value)));
    return true;
  }
  bool close() {
    open_.pop_back();
    return give_if_complete();
  }
  Json& put(Json value) {
    if (open_.empty()) return value_ = std::move(value);
    Json& parent = *open_.back();
    if (parent.is_object()) return parent[key_] = std::move(value);
    return parent.emplace_back(std::move(value));
  }
  bool give_if_complete() {
    if (!open_.empty()) return true;
    if (!in_record_) fail_as_no_object(value_, builder_.place());
    builder_.give(record_key_, value_);
    return true;
  }

  RecordBuilder& builder_;
  bool in_record_ = false;
  std::string record_key_, key_;
  Json value_;               // of record_key_
  std::vector<Json*> open_;  // arrays and objects in value_ that are not closed yet
};

}  // namespace

Record record_of(const Json& json, const std::string& place) {
  if (!json.is_object()) fail_as_no_object(json, place);
  RecordBuilder builder(place);
  for (const auto& [key, value] : json.items()) builder.give(key, value);
  return builder.finish();
}

Record record_of_text(const std::string& text, const std::string& place) {
  RecordBuilder builder(place);
  RecordParser parser(builder);
  try {
    parse_json(text, parser);
  } catch (const Json::exception& wrong) {
    fail_as_no_json(wrong, place);
  }
  return builder.finish();
}

Json json_of_text(const std::string& text, const std::string& place) {
  try {
    return parse_json(text);
  } catch (const Json::exception& wrong) {
    fail_as_no_json(wrong, place);
  }
}

CaseName name_of(const Record& r) {
  return {r.mesh, r.scene,      r.method, r.study,
          r.knob, r.knob_value, r.stop,   unless_implied(r.contact_solver, r.stop, r.knob)};
}

std::string context_word(const Record& record, const std::string& key) {
  return context_word(record.context, key);
}

void Verdict::add(const std::string& remark) {
  if (!remark.empty()) reason += (reason.empty() ? "" : "; ") + remark;
}

void Record::conclude(const Verdict& verdict) {
  status = verdict.status;
  status_reason = verdict.reason;
}

bool is_verified(const Record& record) {
  return record.strain_energy_Nmm || record.equilibrium_residual;
}

bool is_measured(Status status, std::string_view points, bool is_verified) {
  return has_answer(status) ||
         (points == "accuracy" && status == Status::not_converged && is_verified);
}
bool is_measured(const Record& record) {
  return is_measured(record.status, record.points, is_verified(record));
}

}  // namespace airybench
