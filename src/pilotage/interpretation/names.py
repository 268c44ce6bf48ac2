"""What a mark is called, and what its name makes it: the words for walls, doors and the rest."""

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from itertools import pairwise

from pilotage.interpretation.sheet import Mark, Role

WORD = re.compile(r"[A-Z]?[a-z]+|[A-Z]+")
LOCAL_WORD = re.compile(r"[^\W\d_]+")

SPOKEN: Mapping[str, Role] = {
    "label": Role.LABEL,
    "labels": Role.LABEL,
    "start": Role.START,
    "starts": Role.START,
    "goal": Role.GOAL,
    "goals": Role.GOAL,
    "furniture": Role.FURNITURE,
    "ignore": Role.IGNORE,
    "ignored": Role.IGNORE,
    "keepout": Role.KEEP_OUT,
    "nogo": Role.KEEP_OUT,
    "sperrzone": Role.KEEP_OUT,
    "interdit": Role.KEEP_OUT,
    "vietato": Role.KEEP_OUT,
    "prohibido": Role.KEEP_OUT,
    "slow": Role.SLOW,
    "langsam": Role.SLOW,
    "ralentir": Role.SLOW,
    "lento": Role.SLOW,
    "oneway": Role.ONE_WAY,
    "einbahn": Role.ONE_WAY,
    "sensunique": Role.ONE_WAY,
    "sensounico": Role.ONE_WAY,
}
"""The words with which a user tells this program a role; they are always believed."""

VOCABULARY: Mapping[Role, str] = {
    Role.WALL: "wall walls partition partitions wand waende wände mauer mur murs cloison muro muri muros"
    " parete parede paredes pared tabique tabiques muur muren vägg vegg seinä стена стены mauerwerk muratura"
    " murature alvenaria alvenarias duvar duvarlar ściana ściany sciana sciany stěna stěny stena steny zdivo"
    " falak zid zidovi væg vægge väggar 墙 墙体 壁 벽 벽체"
    " column columns col cols pillar pillars stütze stützen stuetze stuetzen säule säulen poteau poteaux"
    " pilier piliers colonna colonne pilastro pilastri columna columnas pilar pilares kolon kolonlar"
    " колонна колонны 柱 기둥"
    " perete pereți pereti стіна стіни tường dinding tembok τοίχος τοίχοι"
    " جدار جدران حائط حوائط دیوار קיר קירות",
    Role.DOOR: "opening openings door doors doorarc doorway doorways threshold thresholds"
    " tür türen tuer tueren schwelle schwellen porte portes seuil seuils porta porte portas soglia soglie"
    " soleira puerta puertas umbral"
    " deur deuren drempel dörr ovi двери дверь drzwi dveře dvere kapı kapi kapılar kapilar ajtó ajtók vrata"
    " dør dører døre dörrar 门 ドア 扉 문"
    " ușă uși двері cửa pintu πόρτα πόρτες باب أبواب ابواب درب דלת דלתות ovet",
    Role.WINDOW: "window windows glaz glazing fenster fenêtre fenetre fenêtres finestra finestre ventana"
    " ventanas janela janelas raam ramen fönster ikkuna окно окна okno okna pencere pencereler ablak ablakok"
    " prozor prozori vindu vindue vinduer 窗 窗户 窓 창문"
    " win fereastră fereastra ferestre вікно вікна ikkunat jendela παράθυρο παράθυρα"
    " نافذة نوافذ شباك شبابيك پنجره חלון חלונות",
    Role.STAIRS: "stair stairs staircase steps treppe treppen escalier escaliers scala scale escalera"
    " escaleras escada trap trappa lift elevator aufzug fahrstuhl ascenseur ascensor escalator лестница"
    " scară scări сходи tangga σκάλα σκάλες درج سلالم پله מדרגות",
    Role.FURNITURE: "furniture furnishing furnishings furn moebel möbel mobilier meuble meubles mobili arredo"
    " mobiliario muebles mobília meubilair möbler equipment equip eqpm appliance appliances fixture"
    " fixtures fixt fitting fittings sanitary sanitär sanitaer sanitaires sanitarios plumbing plmb plumb"
    " kitchenware plants trees cabinet desk chair table sofa bed toilet sink bathtub shower мебель"
    " couch couches sofas bench benches shelf shelves shelving rack racks bookcase bookshelf bookshelves"
    " cabinets cupboard cupboards desks chairs tables beds armchair armchairs stool stools toilets sinks"
    " wardrobe wardrobes dresser dressers nightstand nightstands sideboard sideboards television tv microwave"
    " basin basins washbasin tub stove oven fridge refrigerator dishwasher countertop countertops worktop"
    " crate crates pallet pallets rug rugs washer dryer cooktop hob island counter counters piano printer"
    " whiteboard whiteboards mirror mirrors bidet urinal urinals jacuzzi ottoman pouf conveyor conveyors"
    " lamp lamps lights lighting sockets outlets switches radiator radiators people cars vehicles"
    " einrichtung möblierung moeblierung inventar regal regale schrank schränke schraenke tisch tische stuhl"
    " stühle stuehle bett schreibtisch kommode teppich waschmaschine"
    " стол столы стул стулья диван кровать шкаф шкафы ванна унитаз раковина холодильник"
    " stół stoły krzesło krzesła łóżko szafa szafy biurko kanapa wanna umywalka pralka lodówka"
    " betten bänke baenke sessel waschbecken badewanne spüle herd leuchten steckdosen heizkörper"
    " canapé canape canapés banc bancs étagère étagères etagere etageres armoire armoires lits fauteuil"
    " fauteuils chaise chaises lavabo lavabos baignoire sofá sofás bancos estante estantes"
    " estantería estanterías armario armarios silla sillas mesa mesas cama camas arredi arredamento"
    " divano divani panca panche scaffale scaffali armadio armadi sedia sedie tavolo tavoli letto letti"
    " sanitari meubels kast kasten tafel tafels stoel stoelen bedden rekken mobiliário móveis moveis"
    " prateleira prateleiras armário armários cadeira cadeiras louças meble nábytek nabytek nábytok mobilya"
    " mobilyalar bútor bútorok namještaj møbler huonekalut 家具 洁具 가구"
    " 床 沙发 茶几 桌 椅 凳 柜 冰箱 洗衣机 马桶 浴缸 洗手盆 书架 ベッド ソファ テーブル 机 椅子 冷蔵庫 洗濯機"
    " 침대 소파 식탁 책상 의자 냉장고 세탁기"
    " меблі perabot έπιπλα أثاث اثاث مفروشات مبلمان ריהוט",
    Role.LABEL: "text texts txt anno annotation annotations note notes beschriftung texte testo testi texto"
    " textos tekst raumnamen raumbezeichnung glyph glyphs teksty napisy opisy popisy yazı yazi метки текст"
    " тексты надписи 文字 문자"
    " نص نصوص متن טקסט",
    Role.IGNORE: "dim dims dimension dimensions bemassung bemaßung cote cotes cotation quote quota cota"
    " cotas title titleblock ttlb titleblk schriftfeld cartouche frame border grid axis axes"
    " achse achsen hatch hatching pattern schraffur hachures defpoints viewport viewports"
    " legend north paths route routes fluchtweg fluchtwege rettungsweg rettungswege"
    " landscape landscaping contouring vegetation planting measurement measurements maße medidas misure"
    " maten beam beams joist joists träger traeger balken unterzug unterzüge unterzuege poutre poutres"
    " viga vigas trave travi balk overhang ceiling clng decke plafond soffitto hvac ducts elec elektro"
    " electrical electric electricity électricité electricite elektrik electricidad elettrico elétrica"
    " eletrica"
    " pipe pipes piping cable cables conduit conduits wiring sprinklers rohre leitungen kabel 管线 管道"
    " compass scalebar watermark logo arrow arrows pfeil pfeile flèche flèches freccia frecce flecha flechas"
    " eje ejes eixo eixos oś osie wymiar wymiary aks akslar ölçü olcu ölçüler olculer kóta kóty méretek"
    " tengely оси ось размер размеры штриховка сетка dote 轴线 轴网 标注 尺寸 图框 填充 寸法 通り芯 基準線"
    " グリッド 치수 중심선"
    " leader mleader multileader hilfslinie hilfslinien hilfskonstruktion guide guides guideline guidelines"
    " розміри ukuran διαστάσεις أبعاد ابعاد محاور מידות",
}
"""What people call the layers of their plans, in several languages and in the codes of CAD standards."""

DISCIPLINE = re.compile(r"(?:.*[|$])?[EFMPT]-[A-Z]{4,}\b")
"""What is no part of a building in the codes of CAD standards: electrical, fire, mechanical, plumbing and
telecommunications. The name of another file may stand before."""

EDGES = frozenset(("border", "frame"))
SPACES = frozenset(("room", "rooms", "raum", "räume", "zimmer", "pièce", "salle", "stanza", "sala", "kamer"))
"""The border of a room is its wall, that of a sheet is none; nor is a "bed room" a bed."""

ROOMS = frozenset(("rooms", "räume", "zimmer", "pièces", "salles", "stanze", "salas", "kamers"))
"""A group that is called so holds rooms."""

MEANING = {word: role for role, spoken in VOCABULARY.items() for word in spoken.split()}

THINGS = (Role.DOOR, Role.WINDOW, Role.FURNITURE)
PLACES = frozenset(
    (
        *("toilet", "toilets", "shower", "lavabo", "lavabos"),
        *("sanitary", "sanitär", "sanitaires", "sanitarios"),
        *("equipment", "equip", "plumbing", "fittings", "plants", "people"),
        *("electrical", "electricity", "hvac"),
    )
)
"""Rooms are called by these words for what stands in them."""

NUMBERED = frozenset(("bed", "beds", "cabinet"))
"""With a number, or among rooms, these are rooms, too: bedrooms, and doctors' rooms."""

SHARED = PLACES | NUMBERED
"""Words that rooms share with the things in them."""

HEADS = (
    *("wand", "wände", "waende", "mauer", "tür", "türen", "tuer", "tueren", "fenster", "treppe", "treppen"),
    *("schrank", "schränke", "schraenke", "regal", "regale", "tisch", "tische", "stuhl", "stühle", "stuehle"),
    *("bett", "betten", "träger", "traeger", "balken"),
    *("墙", "墙体", "标注", "尺寸", "轴线", "轴网", "家具", "管线", "管道"),
    *("床", "沙发", "桌", "椅", "凳", "柜", "书架", "ベッド", "ソファ", "テーブル", "침대", "소파", "책상"),
    *("壁", "寸法", "通り芯", "치수", "중심선"),
)
"""What ends with one of these is of its kind: "Stahlträger" is a beam. German and others join their words."""


def words_of(name: str) -> Iterator[str]:
    """Split a name into words of lower case.

    >>> list(words_of("roomLabels_2"))
    ['room', 'labels']
    """
    yield from (word.lower() for word in WORD.findall(name))


def spoken_words(name: str) -> Iterator[str]:
    """Split a name into words of lower case, and pairs of these.

    >>> list(spoken_words("keep-out"))
    ['keepout', 'keep', 'out']
    """
    words = list(words_of(name))
    yield from map("".join, pairwise(words))
    yield from words


def role_named(names: Iterable[str], inherited: Role = Role.WALL) -> Role:
    """Tell a role by the words of this program, of one part or two; IGNORE is never undone."""
    spoken = [SPOKEN[word] for name in names for word in spoken_words(name) if word in SPOKEN]
    if inherited is Role.IGNORE or Role.IGNORE in spoken:
        return Role.IGNORE
    return spoken[0] if spoken else inherited


def colors_of(mark: Mark) -> list[str]:
    """Write the colors of a mark's line and area, by which a person may name it.

    >>> colors_of(Mark((), fill=(1.0, 0.4, 0.0)))
    ['#ff6600']
    """
    colors = ([] if mark.pen is None else [mark.pen.color]) + ([] if mark.fill is None else [mark.fill])
    return ["#" + bytes(round(255.0 * channel) for channel in color).hex() for color in colors]


def told_role(names: Sequence[str], layers: Mapping[str, Role]) -> tuple[Role, str] | None:
    """Tell a role that a person gave, and the name that gave it: a hint, or a word of this program.

    Inner names win over outer ones, but what is ignored stays ignored.
    """
    for name in reversed(names):
        if name in layers:
            return layers[name], f"you said that {name!r} is {layers[name].value}"
    found = None
    for name in names:
        role = role_named([name])
        if role is Role.IGNORE:
            return role, f"its name is {name!r}"
        if role is not Role.WALL:
            found = role, f"its name is {name!r}"
    return found


def guessed_role(names: Sequence[str]) -> tuple[Role, str] | None:
    """Guess a role by what people call their layers, the innermost name first."""
    for place, name in reversed(list(enumerate(names))):
        words = name_words(name)
        of_room = not SPACES.isdisjoint(words)
        below, above = names[place + 1 :], names[place - 1 : place]
        among_rooms = is_room(below[-1:]) if below else holds_rooms(above)
        for word, following in pairwise([*words, ""]):
            role = meaning_of(word)
            is_place = following in SPACES or (among_rooms and word in SHARED)
            if is_place and role in (Role.FURNITURE, Role.IGNORE):
                continue
            if role is not None and not (of_room and word in EDGES):
                return role, f"its name is {name!r}"
        if DISCIPLINE.match(name):
            return Role.IGNORE, f"its name is {name!r}"
    return None


def is_room(names: Iterable[str]) -> bool:
    """Tell whether a name says that something is a room.

    >>> [is_room([name]) for name in ("hp-room", "bedRoom2", "room table")]
    [True, True, False]
    """
    return not SPACES.isdisjoint(last_words(names))


def holds_rooms(names: Iterable[str]) -> bool:
    """Tell whether a name says that a group holds rooms."""
    return not ROOMS.isdisjoint(last_words(names))


def last_words(names: Iterable[str]) -> list[str]:
    """List the last word of each name."""
    return [words[-1] for name in names if (words := name_words(name))]


def meaning_of(word: str) -> Role | None:
    """Tell what a word of lower case makes a mark; None if it says nothing.

    >>> [meaning_of(word) for word in ("shelves", "stahlträger", "kitchen")]
    [<Role.FURNITURE: 'furniture'>, <Role.IGNORE: 'ignore'>, None]
    """
    if word in MEANING:
        return MEANING[word]
    return next((MEANING[head] for head in HEADS if word.endswith(head)), None)


def thing_called(label: str) -> str:
    """Return a label that makes what it is written on a door, a window or furniture; of all others nothing.

    >>> [thing_called(label) for label in ("Coffee table", "Door 2", "Toilet", "Bed 2", "Bed room")]
    ['Coffee table', 'Door 2', '', '', '']
    >>> [thing_called(label) for label in ("Filing cabinet", "Cabinet 2", "Lavabo")]
    ['Filing cabinet', '', '']
    """
    *_, head = name_words(re.sub(r"\(.*?\)", " ", label)) or [""]
    is_room = head in PLACES or (head in NUMBERED and any(map(str.isdecimal, label)))
    return label if meaning_of(head) in THINGS and not is_room else ""


def name_words(name: str) -> list[str]:
    """Split a name in any language into words: A-FURN-FIX, wandInnen, "Türen 2"."""
    spaced = re.sub(r"(?<=[a-zà-öø-ÿ])(?=[A-ZÀ-ÖØ-Þ])", " ", name)
    return [word.lower() for word in LOCAL_WORD.findall(spaced)]
