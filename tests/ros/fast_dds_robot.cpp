// A small simulated robot on Fast DDS, as nodes of ROS 2 use it: publishes rt/scan, rt/odom and rt/tf_static, obeys
// rt/cmd_vel. It shares no code with pilotage. Arguments: domain, file of wall segments (x1 y1 x2 y2 a line) [m],
// start x, y, theta, seconds. At the end, or at SIGTERM, it prints x, y, theta and how many steps touched a wall.
#include <fastcdr/Cdr.h>
#include <fastcdr/FastBuffer.h>
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/topic/TopicDataType.hpp>
#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>
#include <fastrtps/utils/IPLocator.h>

#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <functional>
#include <limits>
#include <string>
#include <thread>
#include <vector>

namespace fast = eprosima::fastdds::dds;
namespace rtps = eprosima::fastrtps::rtps;
using eprosima::fastcdr::Cdr;
using Bytes = std::vector<char>;

constexpr double kPi = 3.14159265358979323846;
constexpr int kBeams = 360;
constexpr float kRangeMax = 12.0F;
constexpr double kRadius = 0.2, kStep = 0.1, kTimeout = 0.5;

// Carries messages as the bytes of their CDR encoding.
class Packed : public fast::TopicDataType {
 public:
  explicit Packed(const std::string& name) {
    setName(name.c_str());
    m_typeSize = 65000;
    auto_fill_type_object(false);
    auto_fill_type_information(false);
  }
  bool serialize(void* data, rtps::SerializedPayload_t* payload) override {
    const auto& bytes = *static_cast<Bytes*>(data);
    std::memcpy(payload->data, bytes.data(), bytes.size());
    payload->length = static_cast<uint32_t>(bytes.size());
    payload->encapsulation = CDR_LE;
    return true;
  }
  bool deserialize(rtps::SerializedPayload_t* payload, void* data) override {
    const auto* first = reinterpret_cast<const char*>(payload->data);
    static_cast<Bytes*>(data)->assign(first, first + payload->length);
    return true;
  }
  std::function<uint32_t()> getSerializedSizeProvider(void* data) override {
    return [data] { return static_cast<uint32_t>(static_cast<Bytes*>(data)->size()); };
  }
  void* createData() override { return new Bytes(); }
  void deleteData(void* data) override { delete static_cast<Bytes*>(data); }
  bool getKey(void*, rtps::InstanceHandle_t*, bool) override { return false; }
};

Bytes packed(const std::function<void(Cdr&)>& write) {
  Bytes bytes(16384);
  eprosima::fastcdr::FastBuffer buffer(bytes.data(), bytes.size());
  Cdr cdr(buffer, Cdr::LITTLE_ENDIANNESS, Cdr::DDS_CDR);
  cdr.serialize_encapsulation();
  write(cdr);
  bytes.resize((cdr.getSerializedDataLength() + 3) / 4 * 4);
  return bytes;
}

void write_header(Cdr& cdr, double stamp, const std::string& frame) {
  const auto seconds = static_cast<int32_t>(std::floor(stamp));
  cdr << seconds << static_cast<uint32_t>((stamp - seconds) * 1e9) << frame;
}

void write_pose(Cdr& cdr, double x, double y, double theta) {
  cdr << x << y << 0.0 << 0.0 << 0.0 << std::sin(theta / 2) << std::cos(theta / 2);
}

struct Segment {
  double x1, y1, x2, y2;
};

float range_to(const std::vector<Segment>& walls, double x, double y, double angle) {
  const double dx = std::cos(angle), dy = std::sin(angle);
  double nearest = std::numeric_limits<double>::infinity();
  for (const auto& wall : walls) {
    const double ex = wall.x2 - wall.x1, ey = wall.y2 - wall.y1, cross = dx * ey - dy * ex;
    if (std::abs(cross) < 1e-12) continue;
    const double ax = wall.x1 - x, ay = wall.y1 - y;
    const double along = (ax * ey - ay * ex) / cross, share = (ax * dy - ay * dx) / cross;
    if (along > 0 && share >= 0 && share <= 1 && along < nearest) nearest = along;
  }
  return nearest < kRangeMax ? static_cast<float>(nearest) : std::numeric_limits<float>::infinity();
}

bool touches(const std::vector<Segment>& walls, double x, double y) {
  for (const auto& wall : walls) {
    const double ex = wall.x2 - wall.x1, ey = wall.y2 - wall.y1, size = ex * ex + ey * ey;
    double share = size > 0 ? ((x - wall.x1) * ex + (y - wall.y1) * ey) / size : 0;
    share = std::fmin(std::fmax(share, 0), 1);
    if (std::hypot(wall.x1 + share * ex - x, wall.y1 + share * ey - y) < kRadius) return true;
  }
  return false;
}

volatile std::sig_atomic_t stopped = 0;

int main(int, char** argv) {
  std::signal(SIGTERM, [](int) { stopped = 1; });
  std::vector<Segment> walls;
  std::ifstream file(argv[2]);
  for (Segment wall{}; file >> wall.x1 >> wall.y1 >> wall.x2 >> wall.y2;) walls.push_back(wall);
  double x = std::atof(argv[3]), y = std::atof(argv[4]), theta = std::atof(argv[5]);
  const double seconds = std::atof(argv[6]), start_x = x, start_y = y, start_theta = theta;

  fast::DomainParticipantQos quality;  // this machine only
  auto transport = std::make_shared<eprosima::fastdds::rtps::UDPv4TransportDescriptor>();
  transport->interfaceWhiteList.emplace_back("127.0.0.1");
  quality.transport().use_builtin_transports = false;
  quality.transport().user_transports.push_back(transport);
  for (int index = 0; index < 8; ++index) {
    rtps::Locator_t peer;
    rtps::IPLocator::setIPv4(peer, 127, 0, 0, 1);
    peer.port = static_cast<uint32_t>(7400 + 250 * std::atoi(argv[1]) + 10 + 2 * index);
    quality.wire_protocol().builtin.initialPeersList.push_back(peer);
  }
  auto* participant =
      fast::DomainParticipantFactory::get_instance()->create_participant(std::atoi(argv[1]), quality);
  auto topic = [&](const std::string& name, const std::string& type) {
    fast::TypeSupport(new Packed(type)).register_type(participant);
    return participant->create_topic(name, type, fast::TOPIC_QOS_DEFAULT);
  };
  auto* publisher = participant->create_publisher(fast::PUBLISHER_QOS_DEFAULT);
  fast::DataWriterQos sensor;
  sensor.reliability().kind = fast::BEST_EFFORT_RELIABILITY_QOS;
  fast::DataWriterQos latched;
  latched.reliability().kind = fast::RELIABLE_RELIABILITY_QOS;
  latched.durability().kind = fast::TRANSIENT_LOCAL_DURABILITY_QOS;
  auto* scans = publisher->create_datawriter(topic("rt/scan", "sensor_msgs::msg::dds_::LaserScan_"), sensor);
  auto* odometry = publisher->create_datawriter(topic("rt/odom", "nav_msgs::msg::dds_::Odometry_"), sensor);
  auto* mounts = publisher->create_datawriter(topic("rt/tf_static", "tf2_msgs::msg::dds_::TFMessage_"), latched);
  fast::DataReaderQos wheel;
  wheel.reliability().kind = fast::BEST_EFFORT_RELIABILITY_QOS;
  auto* commands = participant->create_subscriber(fast::SUBSCRIBER_QOS_DEFAULT)
                       ->create_datareader(topic("rt/cmd_vel", "geometry_msgs::msg::dds_::Twist_"), wheel);

  Bytes mount = packed([](Cdr& cdr) {
    cdr << static_cast<uint32_t>(1);
    write_header(cdr, 0.0, "base_link");
    cdr << std::string("laser") << 0.0 << 0.0 << 0.0 << 0.0 << 0.0 << 0.0 << 1.0;
  });
  mounts->write(&mount);

  double linear = 0, angular = 0, commanded = -1e9;
  int touched = 0;
  auto next = std::chrono::steady_clock::now();
  for (double now = 0; now < seconds && !stopped; now += kStep) {
    Bytes command;
    fast::SampleInfo info;
    while (commands->take_next_sample(&command, &info) == eprosima::fastrtps::types::ReturnCode_t::RETCODE_OK) {
      if (!info.valid_data || command.size() < 52) continue;
      std::memcpy(&linear, &command[4], 8);
      std::memcpy(&angular, &command[4 + 40], 8);
      commanded = now;
    }
    if (now - commanded > kTimeout) linear = angular = 0;
    const double nx = x + linear * kStep * std::cos(theta + angular * kStep / 2);
    const double ny = y + linear * kStep * std::sin(theta + angular * kStep / 2);
    theta += angular * kStep;
    if (touches(walls, nx, ny)) {
      ++touched;
    } else {
      x = nx;
      y = ny;
    }
    const double stamp = 5000.0 + now;
    Bytes place = packed([&](Cdr& cdr) {
      write_header(cdr, stamp, "odom");
      cdr << std::string("base_link");
      const double c = std::cos(start_theta), s = std::sin(start_theta), dx = x - start_x, dy = y - start_y;
      write_pose(cdr, c * dx + s * dy, c * dy - s * dx, theta - start_theta);
      for (int k = 0; k < 36; ++k) cdr << 0.0;
      cdr << linear << 0.0 << 0.0 << 0.0 << 0.0 << angular;
      for (int k = 0; k < 36; ++k) cdr << 0.0;
    });
    odometry->write(&place);
    Bytes scan = packed([&](Cdr& cdr) {
      const auto step = static_cast<float>(2 * kPi / kBeams), first = static_cast<float>(-kPi);
      write_header(cdr, stamp, "laser");
      cdr << first << first + (kBeams - 1) * step << step << 0.0F << 0.0F << 0.05F << kRangeMax;
      std::vector<float> ranges(kBeams);
      for (int k = 0; k < kBeams; ++k) ranges[k] = range_to(walls, x, y, theta + first + k * step);
      cdr << ranges << std::vector<float>();
    });
    scans->write(&scan);
    next += std::chrono::milliseconds(100);
    std::this_thread::sleep_until(next);
  }
  std::printf("%f %f %f %d\n", x, y, theta, touched);
  return 0;
}
