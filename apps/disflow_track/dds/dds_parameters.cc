// SPDX-License-Identifier: BSD-3-Clause
#include "dds/dds_parameters.h"

#include <algorithm>
#include <deque>
#include <set>

#include "program/exit_status.h"

namespace disflow::apps {
namespace {

namespace ros = posix::ros;

/// Of one request; more are not answered. An answer to all that there are fits in.
constexpr std::uint32_t kMostAsked = 1000;

template <class Sequence>
auto SpanOf(const Sequence& sequence) {
  return std::span(sequence._buffer, std::min(sequence._length, kMostAsked));
}

ros::ParameterValue NotSet() {
  static const std::string none;
  ros::ParameterValue value{};
  value.type = kParameterNotSet;
  value.string_value = posix::Lend(none);
  return value;
}

std::vector<WantedParameter> WantedIn(std::span<const ros::Parameter> parameters) {
  std::vector<WantedParameter> wanted;
  for (const ros::Parameter& parameter : parameters)
    wanted.push_back({posix::TextOf(parameter.name), parameter.value});
  return wanted;
}

/// @param range Of either kind, filled for the kind that the parameter is of.
void AddRange(const RosParameter& parameter, ros::FloatingPointRange& of_numbers,
              ros::IntegerRange& of_whole, ros::ParameterDescriptor& descriptor) {
  if (parameter.is_whole) {
    of_whole = {static_cast<std::int64_t>(parameter.min), static_cast<std::int64_t>(parameter.max),
                1};
    descriptor.integer_range = {1, 1, &of_whole, false};
  } else {
    of_numbers = {parameter.min, parameter.max, 0.0};
    descriptor.floating_point_range = {1, 1, &of_numbers, false};
  }
}

}  // namespace

DdsParameters::DdsParameters(const std::string& node_name, std::span<ObjectChannel* const> channels,
                             posix::RosNode& node)
    : node_(node_name), table_(channels) {
  Require(node.Serve(node_ + "/get_parameters", get_));
  Require(node.Serve(node_ + "/get_parameter_types", types_));
  Require(node.Serve(node_ + "/describe_parameters", describe_));
  Require(node.Serve(node_ + "/list_parameters", list_));
  Require(node.Serve(node_ + "/set_parameters", set_));
  Require(node.Serve(node_ + "/set_parameters_atomically", set_atomically_));
  Require(node.Advertise("/parameter_events", posix::RosQos::kReliable, events_));
}

void DdsParameters::Turn() {
  ServeReading();
  ServeSetting();
  TellChanges();
}

void DdsParameters::ServeReading() {
  get_.requests.TakeAll([this](const ros::GetParametersRequest& request) {
    std::vector<ros::ParameterValue> values;
    for (const char* const name : SpanOf(request.names)) {
      const RosParameter* const parameter = table_.Find(posix::TextOf(name));
      values.push_back(parameter == nullptr ? NotSet() : table_.ValueOf(*parameter));
    }
    ros::GetParametersResponse response{};
    response.header = request.header;
    posix::Lend(values, response.values);
    get_.Reply(response);
  });
  types_.requests.TakeAll([this](const ros::GetParameterTypesRequest& request) {
    std::vector<std::uint8_t> types;
    for (const char* const name : SpanOf(request.names)) {
      const RosParameter* const parameter = table_.Find(posix::TextOf(name));
      types.push_back(parameter == nullptr ? kParameterNotSet : table_.ValueOf(*parameter).type);
    }
    ros::GetParameterTypesResponse response{};
    response.header = request.header;
    posix::Lend(types, response.types);
    types_.Reply(response);
  });
  describe_.requests.TakeAll(
      [this](const ros::DescribeParametersRequest& request) { Describe(request); });
  list_.requests.TakeAll([this](const ros::ListParametersRequest& request) { List(request); });
}

void DdsParameters::List(const ros::ListParametersRequest& request) {
  std::set<std::string_view> prefixes;
  for (const char* const prefix : SpanOf(request.prefixes)) prefixes.insert(posix::TextOf(prefix));
  if (prefixes.empty()) prefixes.insert("");
  std::set<std::string> names;
  std::set<std::string> groups;
  for (const std::string_view prefix : prefixes) {
    for (const RosParameter* const parameter : table_.List(prefix, request.depth)) {
      names.insert(parameter->name);
      groups.insert(parameter->name.substr(0, parameter->name.rfind('.')));
    }
  }
  const auto texts_of = [](const std::set<std::string>& some) {
    std::vector<char*> texts;
    texts.reserve(some.size());
    for (const std::string& text : some) texts.push_back(posix::Lend(text));
    return texts;
  };
  std::vector<char*> name_texts = texts_of(names);
  std::vector<char*> group_texts = texts_of(groups);
  ros::ListParametersResponse response{};
  response.header = request.header;
  posix::Lend(name_texts, response.result.names);
  posix::Lend(group_texts, response.result.prefixes);
  list_.Reply(response);
}

void DdsParameters::Describe(const ros::DescribeParametersRequest& request) {
  static const std::string none;
  std::vector<ros::ParameterDescriptor> descriptors;
  // In place: descriptors point to them.
  std::deque<std::string> names;
  std::deque<ros::FloatingPointRange> ranges;
  std::deque<ros::IntegerRange> whole_ranges;
  for (const char* const text : SpanOf(request.names)) {
    const std::string_view name = posix::TextOf(text);
    ros::ParameterDescriptor descriptor{};
    descriptor.name = posix::Lend(names.emplace_back(name));
    descriptor.description = posix::Lend(none);
    descriptor.additional_constraints = posix::Lend(none);
    if (const RosParameter* const parameter = table_.Find(name)) {
      descriptor.type = table_.ValueOf(*parameter).type;
      descriptor.description = posix::Lend(parameter->description);
      descriptor.read_only = parameter->is_read_only;
      AddRange(*parameter, ranges.emplace_back(), whole_ranges.emplace_back(), descriptor);
    }
    descriptors.push_back(descriptor);
  }
  ros::DescribeParametersResponse response{};
  response.header = request.header;
  posix::Lend(descriptors, response.descriptors);
  describe_.Reply(response);
}

void DdsParameters::ServeSetting() {
  set_.requests.TakeAll([this](const ros::SetParametersRequest& request) {
    std::deque<std::string> reasons;
    std::vector<ros::SetParametersResult> results;
    for (const WantedParameter& wanted : WantedIn(SpanOf(request.parameters))) {
      const std::string& reason = reasons.emplace_back(table_.Set({&wanted, 1}));
      results.push_back({reason.empty(), posix::Lend(reason)});
    }
    ros::SetParametersResponse response{};
    response.header = request.header;
    posix::Lend(results, response.results);
    set_.Reply(response);
  });
  set_atomically_.requests.TakeAll([this](const ros::SetParametersAtomicallyRequest& request) {
    const bool is_too_long = request.parameters._length > kMostAsked;
    const std::string reason =
        is_too_long ? "too many at once" : table_.Set(WantedIn(SpanOf(request.parameters)));
    set_atomically_.Reply({request.header, {reason.empty(), posix::Lend(reason)}});
  });
}

void DdsParameters::TellChanges() {
  std::vector<ros::Parameter> changed;
  for (const RosParameter* const parameter : table_.TakeChanges())
    changed.push_back({posix::Lend(parameter->name), table_.ValueOf(*parameter)});
  if (changed.empty()) return;
  ros::ParameterEvent event{};
  event.stamp = posix::RosTime(dds_time());
  event.node = posix::Lend(node_);
  posix::Lend(changed, event.changed_parameters);
  // Whoever missed it asks.
  (void)events_.Publish(event);
}

}  // namespace disflow::apps
