"""What each operation does, by theme: importing this package fills the one table."""

from rapidgen.faces.rws.handlers import backups as backups
from rapidgen.faces.rws.handlers import cfg as cfg
from rapidgen.faces.rws.handlers import dialogs as dialogs
from rapidgen.faces.rws.handlers import elog as elog
from rapidgen.faces.rws.handlers import execution as execution
from rapidgen.faces.rws.handlers import files as files
from rapidgen.faces.rws.handlers import masterships as masterships
from rapidgen.faces.rws.handlers import mechanics as mechanics
from rapidgen.faces.rws.handlers import motion as motion
from rapidgen.faces.rws.handlers import networks as networks
from rapidgen.faces.rws.handlers import panel as panel
from rapidgen.faces.rws.handlers import pointers as pointers
from rapidgen.faces.rws.handlers import programs as programs
from rapidgen.faces.rws.handlers import queues as queues
from rapidgen.faces.rws.handlers import signals as signals
from rapidgen.faces.rws.handlers import subscribing as subscribing
from rapidgen.faces.rws.handlers import symbols as symbols
from rapidgen.faces.rws.handlers import system as system
from rapidgen.faces.rws.handlers import tasks as tasks
from rapidgen.faces.rws.handlers import texts as texts
from rapidgen.faces.rws.handlers import users as users
