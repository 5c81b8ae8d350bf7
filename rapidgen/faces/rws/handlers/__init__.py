"""What each operation does, by theme: importing this package fills the one table."""

from rapidgen.faces.rws.handlers import cfg as cfg
from rapidgen.faces.rws.handlers import elog as elog
from rapidgen.faces.rws.handlers import execution as execution
from rapidgen.faces.rws.handlers import files as files
from rapidgen.faces.rws.handlers import motion as motion
from rapidgen.faces.rws.handlers import panel as panel
from rapidgen.faces.rws.handlers import signals as signals
from rapidgen.faces.rws.handlers import subscribing as subscribing
from rapidgen.faces.rws.handlers import symbols as symbols
from rapidgen.faces.rws.handlers import system as system
from rapidgen.faces.rws.handlers import tasks as tasks
from rapidgen.faces.rws.handlers import users as users
