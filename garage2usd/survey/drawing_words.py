"""Words of drawings and building models: the parts that names of layers and elements tell, in many languages."""

import re
import unicodedata
from enum import StrEnum
from functools import cache

from garage2usd.config.stalls import SizeClass
from garage2usd.garage import StallUse
from garage2usd.survey.survey import PortalKind
from garage2usd.survey.text import size_of, use_of


class PartKind(StrEnum):
    """Parts of a garage that a name can tell."""

    NOTE = "note"
    VEHICLE = "vehicle"
    LANE = "lane"
    COLUMN = "column"
    DOOR = "door"
    RAMP = "ramp"
    SOLID = "solid"
    OUTLINE = "outline"
    WALL = "wall"
    MOUTH = "mouth"
    STALL = "stall"


_WORDS = {
    PartKind.NOTE: (
        "=dim =dims dimension =anno bemass kotierung masskette =cota =cotas cotation =axis =axes "
        "=grid =achse =achsen =eje =ejes =assi title titre plankopf rahmen parkett parquet =defpoints "
        "viewport legend 标注 轴线 轴网 图框 尺寸 文字 치수"
    ),
    PartKind.VEHICLE: "=cars =vehicle =vehicles =autos fahrzeug vehicul vehicol vehiculo 车辆 汽车",
    PartKind.LANE: (
        "=lane =lanes aisle driveway =drive carriageway roadway centerline centreline fahrgasse "
        "fahrbahn fahrspur fahrweg fahrstreifen circulation =voie =voies =allee carril corsia calle "
        "=rijbaan rijstrook proezd проезд 车道 车行道 行车 通路 車路 車道 차로 차도 korbana prejazd"
    ),
    PartKind.COLUMN: (
        "column =col =cols pillar stutze saule poteau pilier columna colonne colonna =pilar =pilares "
        "pilastr =pilastro kolom slup sloup колонн столб 柱 기둥"
    ),
    PartKind.DOOR: (
        "=door =doors =gate =gates portal shutter =tor =tore garagentor rolltor sectionaltor =tur "
        "=turen entrance =entry =entries =exit =exits einfahrt ausfahrt zufahrt =porte =portes "
        "portail entree =sortie puerta =porta =porte porton entrada salida ingresso uscita =deur "
        "poort ворота дверь въезд выезд =门 大门 入口 出口 出入口 문"
    ),
    PartKind.RAMP: "=ramp =ramps rampe rampa hellingbaan рампа пандус 坡道 斜路 경사로 램프",
    PartKind.SOLID: (
        "stair =block =blocks =lift =lifts elevator =core =cores =shaft =shafts treppe aufzug schacht "
        "fahrstuhl escalier ascenseur escalera ascensor =scala =scale trappen =trap лестниц лифт 楼梯 "
        "电梯 階段 계단 엘리베이터"
    ),
    PartKind.OUTLINE: (
        "outline =otln umriss kontur contour =boundary perimeter =slab =slabs grundriss aussenkante "
        "emprise contorno perimetro =limite контур 轮廓 边界 外郭"
    ),
    PartKind.WALL: (
        "=wall =walls wand =wande mauer =mur =murs =muro =muros =muri parete pared =parede стена "
        "стены =墙 墙体 墙线 外墙 剪力墙 벽 壁"
    ),
    PartKind.MOUTH: "=mouth =mouths",
    PartKind.STALL: (
        "park =stall =stalls =bay =bays =pkng =prkg =pkg =strp striping stellplatz =pkw "
        "estacionamiento estacionamento aparcamiento =plaza =plazas =vaga =vagas parcheggi posto_auto "
        "posti_auto stationnement =place =places парков машиномест 车位 停车 駐車 車位 주차"
    ),
}
"""Words of each part, the first that a name contains tells it; one with ``=`` must be a word of its own."""
_NUMBERED = re.compile(r"[0-9]*$")
_USES = {
    StallUse.ACCESSIBLE: ("behindert", "rollstuhl", "barrierefrei", "=ada", "handicap", "=pmr", "minusval", "discapac",
                          "disab", "invalid", "инвалид", "无障碍", "残疾", "障害者", "장애인"),
    StallUse.EV: ("=ev", "=evcs", "=e-auto", "elektro", "elektr", "ladeplatz", "ladesaule", "ladestation", "recharge",
                  "borne", "recarga", "ricarica", "充电", "電気", "전기"),
}  # fmt: skip
_COMPACT = ("kleinwagen", "citadine", "pequeno", "경차", "경형", "微型", "軽自動車")
_ONE_WAY = (
    "one way",
    "oneway",
    "einbahn",
    "einrichtung",
    "sens unique",
    "sentido unico",
    "senso unico",
    "单行",
    "一方通行",
)
_NUMBER = re.compile(r"(?=.*\d)[\w\-./]{1,12}")
_ENTRANCES = ("entrance", "entry", "entree", "einfahrt", "zufahrt", "entrada", "ingresso", "въезд", "入口", "=in")
_EXITS = ("exit", "ausfahrt", "sortie", "salida", "saida", "uscita", "выезд", "出口", "=out")


def _plain(text: str) -> str:
    """Return a text in small letters without accents, its separators as spaces."""
    bare = "".join(sign for sign in unicodedata.normalize("NFKD", text) if not unicodedata.combining(sign))
    whole = unicodedata.normalize("NFC", bare)  # syllables of Korean, which NFKD takes apart
    return re.sub(r"[\W_]+", " ", re.sub(r"(?<=[a-z])(?=[A-Z])", " ", whole)).casefold().strip()


def _contains(plain: str, words: tuple[str, ...]) -> bool:
    tokens = {_NUMBERED.sub("", token) for token in plain.split()}
    return any(word[1:] in tokens if word[0] == "=" else word.replace("_", " ") in plain for word in words)


_KINDS = {kind: tuple(dict.fromkeys(words.split())) for kind, words in _WORDS.items()}


@cache
def kind_of(name: str) -> PartKind | None:
    """Return the part that the name of a layer, block, space or element tells; None if it tells none.

    For example ``A-COLS`` and ``Stützen`` are columns, ``B1$0$车位线`` and ``Stellplatz_EV`` stalls.
    """
    plain = _plain(name)
    return next((kind for kind, words in _KINDS.items() if _contains(plain, words)), None)


def use_told(*names: str) -> StallUse:
    """Return the use of a stall that names tell, in the words of several languages."""
    plain = [_plain(name) for name in names]
    told = next((use for name in plain for use, words in _USES.items() if _contains(name, words)), None)
    return told or use_of([*names, *plain])


def size_told(*names: str) -> SizeClass:
    """Return the size class of a stall that names tell."""
    plain = [_plain(name) for name in names]
    return SizeClass.COMPACT if any(_contains(name, _COMPACT) for name in plain) else size_of(plain)


def portal_told(*names: str) -> PortalKind:
    """Return the kind of portal that names tell: an entrance or an exit if one of the two is named, else both."""
    plain = " ".join(map(_plain, names))
    enters, leaves = (_contains(plain, words) for words in (_ENTRANCES, _EXITS))
    if enters == leaves:
        return PortalKind.BOTH
    return PortalKind.ENTRANCE if enters else PortalKind.EXIT


def is_one_way(*names: str) -> bool:
    """Return True if names tell a lane for one direction."""
    return any(_contains(_plain(name), _ONE_WAY) for name in names)


def number_told(*texts: str) -> str:
    """Return the number of a stall that texts tell, the first or its last word that does; empty if none does."""
    for text in texts:
        last = text.split()[-1] if text.split() else ""
        for word in (text.strip(), last):
            if _NUMBER.fullmatch(word):
                return word
    return ""
