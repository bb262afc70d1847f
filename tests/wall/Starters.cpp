#include "Starters.h"

#include <fmt/format.h>
#include <netdb.h>
#include <netinet/in.h>
#include <pwd.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <filesystem>

namespace gnomon::wall {
namespace {

std::string userName() {
    const passwd* entry = ::getpwuid(::geteuid());
    return entry == nullptr ? std::string{} : entry->pw_name;
}

/// The first that is not installed.
std::optional<std::string> missing(std::initializer_list<const char*> programs) {
    for (const char* program : programs)
        if (installed(program).empty()) return fmt::format("there is no {} here", program);
    return {};
}

/// Runs a program to its end; false where it fails.
bool succeeds(const std::string& program, std::vector<std::string> arguments,
              std::vector<std::string> environment = {}) {
    Program run{std::move(arguments), std::move(environment), installed(program)};
    return run.wait() == 0;
}

/// OpenSSH's own daemon and client on a port of their own, with keys of their own.
class Ssh final : public Starter {
public:
    std::optional<std::string> begin(const Folder& folder) override {
        if (auto why = missing({"sshd", "ssh", "ssh-keygen"})) return why;
        // Where it lets go of its rights; only root has them.
        if (::geteuid() == 0) ::mkdir("/run/sshd", 0755);
        for (const char* key : {"host", "user"})
            if (!succeeds("ssh-keygen", {"-q", "-t", "ed25519", "-N", "", "-f", folder.path(key)}))
                return "ssh-keygen makes no key";
        const int port = freePort();
        const auto config = folder.write(
            "sshd_config",
            fmt::format("Port {}\nListenAddress 127.0.0.1\nHostKey {}\nAuthorizedKeysFile {}\n"
                        "PidFile none\nUsePAM no\nStrictModes no\nPasswordAuthentication no\n"
                        "KbdInteractiveAuthentication no\nMaxStartups 100\n",
                        port, folder.path("host"), folder.path("user.pub")));
        clientConfig_ = folder.write(
            "ssh_config",
            fmt::format("Host *\nHostName 127.0.0.1\nPort {}\nUser {}\nIdentityFile {}\n"
                        "IdentitiesOnly yes\nUserKnownHostsFile {}\nStrictHostKeyChecking no\n",
                        port, userName(), folder.path("user"), folder.path("known")));
        daemon_ = std::make_unique<Program>(std::vector<std::string>{"-D", "-e", "-f", config},
                                            std::vector<std::string>{}, installed("sshd"));
        if (!daemon_->complains("Server listening"))
            return "sshd does not start: " +
                   (daemon_->errors().empty() ? "" : daemon_->errors().back());
        // An account that nobody may use has no shell to start anything with.
        if (!succeeds("ssh", {"-F", clientConfig_, "-o", "BatchMode=yes", host(), "true"}))
            return "nobody can log in here";
        return {};
    }
    std::string host() const override { return "0.0.0.0"; }
    std::string lines() const override {
        return fmt::format("launch = \"ssh\"\noptions = [\"-F\", \"{}\"]\n", clientConfig_);
    }

private:
    std::string clientConfig_;
    std::unique_ptr<Program> daemon_;
};

/// Slurm's daemons for a cluster of this machine.
class Slurm final : public Starter {
public:
    std::optional<std::string> begin(const Folder& folder) override {
        if (auto why = missing({"slurmctld", "slurmd", "srun", "munged"})) return why;
        if (host().empty()) return "this machine's name is none of its addresses'";
        for (const char* name : {"state", "spool"}) ::mkdir(folder.path(name).c_str(), 0700);
        const auto secret = folder.write("munge.key", std::string(1024, 'k'));
        ::chmod(secret.c_str(), 0600);
        const auto socket = folder.path("munge.sock");
        start("munged",
              {"--foreground", "--force", "--key-file=" + secret, "--socket=" + socket,
               "--pid-file=" + folder.path("munge.pid"), "--log-file=" + folder.path("munge.log"),
               "--seed-file=" + folder.path("munge.seed")});
        if (!daemons_.back()->complains("work threads")) return failure("munged");
        config_ = folder.write("slurm.conf", configText(folder, socket));
        start("slurmctld", {"-D", "-f", config_});
        start("slurmd", {"-D", "-N", host(), "-f", config_});
        // Waits until the node has reported.
        if (!succeeds("srun", {"--nodes=1", "--ntasks=1", "true"}, environment()))
            return failure("slurmctld") + "; " + failure("slurmd");
        return {};
    }
    std::string host() const override { return ownName(); }
    std::string lines() const override { return "launch = \"slurm\"\n"; }
    std::vector<std::string> environment() const override { return {"SLURM_CONF=" + config_}; }
    ~Slurm() override {
        // The last one serves the others. slurmd's own children, one a job, end with their jobs.
        while (!daemons_.empty()) {
            daemons_.back()->signal(SIGTERM);
            daemons_.back()->wait();
            daemons_.pop_back();
        }
    }

private:
    void start(const std::string& program, std::vector<std::string> arguments) {
        daemons_.push_back(
            std::make_unique<Program>(std::move(arguments), environment(), installed(program)));
    }
    std::string failure(const std::string& program) {
        for (const auto& daemon : daemons_)
            if (programOf(daemon->pid()) == program && !daemon->errors().empty())
                return program + ": " + daemon->errors().back();
        return program + " does not start";
    }
    std::string configText(const Folder& folder, const std::string& socket) const {
        const auto user = userName();
        return fmt::format(
            "ClusterName=gnomon\nSlurmctldHost={0}(127.0.0.1)\nSlurmUser={1}\nSlurmdUser={1}\n"
            "SlurmctldPort={2}\nSlurmdPort={3}\nAuthType=auth/munge\nAuthInfo=socket={4}\n"
            "CredType=cred/munge\nStateSaveLocation={5}\nSlurmdSpoolDir={6}\n"
            "SlurmctldPidFile={7}\nSlurmdPidFile={8}\nProctrackType=proctrack/pgid\n"
            "TaskPlugin=task/none\nSwitchType=switch/none\nMpiDefault=none\n"
            "SelectType=select/cons_tres\nSelectTypeParameters=CR_Core\n"
            "JobAcctGatherType=jobacct_gather/none\n"
            "AccountingStorageType=accounting_storage/none\nReturnToService=2\n"
            "NodeName={0} NodeAddr=127.0.0.1 CPUs={9} State=UNKNOWN\n"
            // As many jobs on a core as a wall has servers, and more.
            "PartitionName=wall Nodes={0} Default=YES MaxTime=INFINITE State=UP "
            "OverSubscribe=FORCE:16\n",
            host(), user, freePort(), freePort(), socket, folder.path("state"),
            folder.path("spool"), folder.path("slurmctld.pid"), folder.path("slurmd.pid"),
            ::sysconf(_SC_NPROCESSORS_ONLN));
    }

    std::string config_;
    std::vector<std::unique_ptr<Program>> daemons_;
};

/// Open MPI's mpirun, which for its own machine needs nobody else.
class Mpi final : public Starter {
public:
    std::optional<std::string> begin(const Folder&) override {
        if (auto why = missing({"mpirun"})) return why;
        if (host().empty()) return "this machine's name is none of its addresses'";
        if (!succeeds("mpirun", {"--host", host(), "-n", "1", "true"}, environment()))
            return "mpirun starts nothing here";
        return {};
    }
    std::string host() const override { return ownName(); }
    std::string lines() const override { return "launch = \"mpi\"\n"; }
    std::vector<std::string> environment() const override {
        return {"OMPI_ALLOW_RUN_AS_ROOT=1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1"};
    }
};

}  // namespace

std::unique_ptr<Starter> sshStarter() { return std::make_unique<Ssh>(); }
std::unique_ptr<Starter> slurmStarter() { return std::make_unique<Slurm>(); }
std::unique_ptr<Starter> mpiStarter() { return std::make_unique<Mpi>(); }

std::string installed(const std::string& program) {
    for (const char* folder : {"/usr/bin/", "/usr/sbin/", "/usr/local/bin/", "/usr/local/sbin/"})
        if (::access((folder + program).c_str(), X_OK) == 0) return folder + program;
    return {};
}

std::string ownName() {
    std::array<char, 256> name{};
    if (::gethostname(name.data(), name.size() - 1) != 0) return {};
    const addrinfo hints{.ai_flags = 0,
                         .ai_family = AF_INET,
                         .ai_socktype = SOCK_STREAM,
                         .ai_protocol = 0,
                         .ai_addrlen = 0,
                         .ai_addr = nullptr,
                         .ai_canonname = nullptr,
                         .ai_next = nullptr};
    addrinfo* found = nullptr;
    if (::getaddrinfo(name.data(), nullptr, &hints, &found) != 0) return {};
    // An address is its own where something can be bound to it.
    const int probe = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    const bool own = ::bind(probe, found->ai_addr, found->ai_addrlen) == 0;
    ::close(probe);
    ::freeaddrinfo(found);
    return own ? name.data() : std::string{};
}

}  // namespace gnomon::wall
