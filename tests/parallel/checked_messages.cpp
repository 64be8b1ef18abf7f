/// To be preloaded into a program of several ranks: watches over the memory of messages that are
/// under way, by MPI's profiling interface, and has messages come late and in other orders.
///
/// What is being sent must not change until the send is complete. What is being received is kept
/// apart until then: the program's memory holds NaN meanwhile, which spoils the result of whoever
/// reads it too early, and must still hold it at the end. A breach ends all ranks.
///
///   MPM_MESSAGES_DELAY   microseconds that a message waits at most, one in four (0)
///   MPM_MESSAGES_SEED    other seeds, other messages; each rank adds its number
///   MPM_MESSAGES_COUNT   if set, each rank says at its end how many messages were watched over

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <map>
#include <vector>

#include <mpi.h>
#include <unistd.h>

namespace {

constexpr unsigned char not_a_number = 0xff;

struct Message {
  bool is_received;
  unsigned char* memory;              ///< the program's
  std::vector<unsigned char> apart;   ///< what comes, or a copy of what goes
  std::vector<unsigned char> before;  ///< what the memory of a message that comes held
};

std::map<MPI_Request, Message> under_way;
long sent = 0, received = 0;

unsigned random_below(unsigned bound)
{
  static unsigned state = [] {
    const char* seed = std::getenv("MPM_MESSAGES_SEED");
    int rank = 0;
    PMPI_Comm_rank(MPI_COMM_WORLD, &rank);
    return 1000u * unsigned(seed ? std::atoi(seed) : 1) + unsigned(rank);
  }();
  return unsigned(rand_r(&state)) % bound;
}

void wait_a_little()
{
  static const char* const text = std::getenv("MPM_MESSAGES_DELAY");
  static const int most = text ? std::atoi(text) : 0;
  if (most > 0 && random_below(4) == 0) usleep(random_below(unsigned(most)));
}

/// Of a message without gaps; 0 for others, which are let through.
std::size_t bytes_of(int count, MPI_Datatype type)
{
  int size;
  MPI_Aint lower, extent;
  PMPI_Type_size(type, &size);
  PMPI_Type_get_extent(type, &lower, &extent);
  return lower == 0 && extent == size ? std::size_t(count) * std::size_t(size) : 0;
}

[[noreturn]] void breach(const char* what)
{
  int rank = 0;
  PMPI_Comm_rank(MPI_COMM_WORLD, &rank);
  std::fprintf(stderr, "checked messages: rank %d: %s\n", rank, what);
  PMPI_Abort(MPI_COMM_WORLD, 86);
  std::abort();
}

void watch_send(const void* memory, int count, MPI_Datatype type, MPI_Request request)
{
  const std::size_t bytes = bytes_of(count, type);
  if (bytes == 0) return;
  // Sends only lend their memory: it is never written to here.
  auto* begin = const_cast<unsigned char*>(static_cast<const unsigned char*>(memory));
  under_way[request] = {false, begin, {begin, begin + bytes}, {}};
  ++sent;
}

void complete(Message& message, const MPI_Status& status)
{
  const std::size_t bytes = message.apart.size();
  if (!message.is_received) {
    if (std::memcmp(message.memory, message.apart.data(), bytes) != 0)
      breach("what is being sent was changed before it had gone");
    return;
  }
  for (std::size_t k = 0; k < bytes; ++k)
    if (message.memory[k] != not_a_number)
      breach("memory was written to that a message was about to come to");
  int came = 0;
  PMPI_Get_count(&status, MPI_BYTE, &came);
  std::memcpy(message.memory, message.before.data(), bytes);
  std::memcpy(message.memory, message.apart.data(), std::size_t(came));
}

/// What of these requests is watched over, in their order; to be asked before they are completed.
std::vector<std::map<MPI_Request, Message>::node_type> taken(int count, const MPI_Request* requests)
{
  std::vector<std::map<MPI_Request, Message>::node_type> found;
  for (int k = 0; k < count; ++k) found.push_back(under_way.extract(requests[k]));
  return found;
}

template <class Call>
int complete_all(int count, MPI_Request* requests, const int* done, MPI_Status* statuses, Call call)
{
  auto messages = taken(count, requests);
  std::vector<MPI_Status> own(static_cast<std::size_t>(count));
  const int result = call(own.data());
  for (int k = 0; k < count; ++k) {
    auto& message = messages[std::size_t(k)];
    if (message.empty()) continue;
    if (*done)
      complete(message.mapped(), own[std::size_t(k)]);
    else
      under_way.insert(std::move(message));
  }
  if (*done && statuses != MPI_STATUSES_IGNORE) std::copy(own.begin(), own.end(), statuses);
  return result;
}

}  // namespace

extern "C" {

int MPI_Isend(const void* memory, int count, MPI_Datatype type, int to, int tag, MPI_Comm comm,
              MPI_Request* request)
{
  wait_a_little();
  const int result = PMPI_Isend(memory, count, type, to, tag, comm, request);
  watch_send(memory, count, type, *request);
  return result;
}

int MPI_Issend(const void* memory, int count, MPI_Datatype type, int to, int tag, MPI_Comm comm,
               MPI_Request* request)
{
  wait_a_little();
  const int result = PMPI_Issend(memory, count, type, to, tag, comm, request);
  watch_send(memory, count, type, *request);
  return result;
}

int MPI_Irecv(void* memory, int count, MPI_Datatype type, int from, int tag, MPI_Comm comm,
              MPI_Request* request)
{
  const std::size_t bytes = bytes_of(count, type);
  if (bytes == 0) return PMPI_Irecv(memory, count, type, from, tag, comm, request);
  auto* begin = static_cast<unsigned char*>(memory);
  Message message{true, begin, std::vector<unsigned char>(bytes), {begin, begin + bytes}};
  std::memset(memory, not_a_number, bytes);
  const int result = PMPI_Irecv(message.apart.data(), count, type, from, tag, comm, request);
  under_way[*request] = std::move(message);
  ++received;
  return result;
}

int MPI_Waitall(int count, MPI_Request* requests, MPI_Status* statuses)
{
  const int done = 1;
  wait_a_little();
  return complete_all(count, requests, &done, statuses,
                      [&](MPI_Status* own) { return PMPI_Waitall(count, requests, own); });
}

int MPI_Testall(int count, MPI_Request* requests, int* done, MPI_Status* statuses)
{
  return complete_all(count, requests, done, statuses,
                      [&](MPI_Status* own) { return PMPI_Testall(count, requests, done, own); });
}

int MPI_Wait(MPI_Request* request, MPI_Status* status)
{
  MPI_Status own;
  const int result = MPI_Waitall(1, request, &own);
  if (status != MPI_STATUS_IGNORE) *status = own;
  return result;
}

int MPI_Test(MPI_Request* request, int* done, MPI_Status* status)
{
  MPI_Status own;
  const int result = MPI_Testall(1, request, done, &own);
  if (*done && status != MPI_STATUS_IGNORE) *status = own;
  return result;
}

int MPI_Finalize()
{
  if (!under_way.empty()) breach("the program ends with messages under way");
  if (std::getenv("MPM_MESSAGES_COUNT"))
    std::fprintf(stderr, "checked messages: %ld sent, %ld received\n", sent, received);
  return PMPI_Finalize();
}
}
