"""Drawings in people's manner, made from a true plan: a ladder of deformation with truth carried along."""

from pilotage.evaluation.deformation.deform import deform
from pilotage.evaluation.deformation.plan import Plan, read_plan
from pilotage.evaluation.deformation.statistics import Statistics, statistics_of

__all__ = ["Plan", "Statistics", "deform", "read_plan", "statistics_of"]
