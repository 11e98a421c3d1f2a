"""Virtual testbench for the elastostatics of hexapods: simulate, compare, fit, diagnose, discover, design, predict.

>>> import hexbench
>>> campaign = hexbench.load("hexapod.toml", "measurements.csv")          # doctest: +SKIP
>>> diagnosis = hexbench.diagnose(campaign, holdout="holdout.csv")        # doctest: +SKIP
>>> diagnosis.verdict, diagnosis.added                                    # doctest: +SKIP
('named', ['base-compliance'])

Poses are [a, b, c] in mm and [alpha, beta, gamma] in deg (extrinsic X-Y-Z) of the mobile frame in the fixed frame; wrenches
are [fx, fy, fz] in N and [mx, my, mz] in N m on the platform, at the mobile origin, in fixed axes; deflections are loaded
minus reference, in um and urad. Names and units are those of the files.
"""

from hexbench import blocks, commands
from hexbench._native import __version__
from hexbench.campaign import Campaign, load
from hexbench.designing import Plan, SensorChoice, choose_sensors, design
from hexbench.diagnosing import Comparison, Diagnosis, compare, diagnose, terms
from hexbench.discovering import Discovery, discover
from hexbench.entrants import Answer, Case, ChallengeRun, StudyTrial, answer_challenge, study_columns
from hexbench.errors import BadInput, HexbenchError, HexbenchWarning, InputOutput, NotDetermined, UsageError
from hexbench.estimator import HexapodModel
from hexbench.gating import gate_check, gate_record
from hexbench.machine import Hexapod
from hexbench.model import Correction, Model, PlatformStiffness, fit, predict
from hexbench.own_term import Parameter, ShapeParameter, Term
from hexbench.scenes import Scene, Simulation, simulate
from hexbench.session import Session, SessionStep, load_session

__all__ = [
    "Answer",
    "BadInput",
    "Campaign",
    "Case",
    "ChallengeRun",
    "Comparison",
    "Correction",
    "Diagnosis",
    "Discovery",
    "Hexapod",
    "HexapodModel",
    "HexbenchError",
    "HexbenchWarning",
    "InputOutput",
    "Model",
    "NotDetermined",
    "Parameter",
    "Plan",
    "PlatformStiffness",
    "Scene",
    "SensorChoice",
    "Session",
    "SessionStep",
    "ShapeParameter",
    "Simulation",
    "StudyTrial",
    "Term",
    "UsageError",
    "__version__",
    "answer_challenge",
    "blocks",
    "choose_sensors",
    "commands",
    "compare",
    "design",
    "diagnose",
    "discover",
    "fit",
    "gate_check",
    "gate_record",
    "load",
    "load_session",
    "predict",
    "simulate",
    "study_columns",
    "terms",
]
