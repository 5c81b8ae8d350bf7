"""Handlers of operations by theme.

Importing this package fills the routing table.
"""

from rapidgen.servers.rws.handlers import backups as backups
from rapidgen.servers.rws.handlers import cfg as cfg
from rapidgen.servers.rws.handlers import dialogs as dialogs
from rapidgen.servers.rws.handlers import elog as elog
from rapidgen.servers.rws.handlers import execution as execution
from rapidgen.servers.rws.handlers import files as files
from rapidgen.servers.rws.handlers import masterships as masterships
from rapidgen.servers.rws.handlers import mechanics as mechanics
from rapidgen.servers.rws.handlers import motion as motion
from rapidgen.servers.rws.handlers import networks as networks
from rapidgen.servers.rws.handlers import panel as panel
from rapidgen.servers.rws.handlers import pointers as pointers
from rapidgen.servers.rws.handlers import programs as programs
from rapidgen.servers.rws.handlers import queues as queues
from rapidgen.servers.rws.handlers import signals as signals
from rapidgen.servers.rws.handlers import subscribing as subscribing
from rapidgen.servers.rws.handlers import symbols as symbols
from rapidgen.servers.rws.handlers import system as system
from rapidgen.servers.rws.handlers import tasks as tasks
from rapidgen.servers.rws.handlers import texts as texts
from rapidgen.servers.rws.handlers import users as users
